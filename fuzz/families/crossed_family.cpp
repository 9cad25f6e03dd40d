// The family `crossed`. Each query is made so that x0 - base = s α q + β r + τ w (contacts.hpp). Here s =
// alpha_sign(kind), q and r are the sides, w is the relative velocity of the points of contact, and τ = t -
// time is the time since the contact. F, the coplanarity cubic, is the determinant of x0 - base, q and r. So
// F is τ det(w, q(t), r(t)), and the choice of w, q and r determines the roots.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "fuzz/families/contacts.hpp"
#include "fuzz/families/crossed.hpp"
#include "fuzz/families/tables.hpp"

namespace nearmiss::crossed {

namespace {

using Vector = Vector3<double>;

/// The sides at the contact, their velocities, and the relative velocity w of the points of contact.
struct Draft {
  Vector q, r, q_velocity, r_velocity, w;
};

/// A nonzero vector whose components are small integers.
Vector small(Random& random) {
  const Vector v = random.integer_vector(7);
  return v.isZero() ? Vector(Vector::UnitX()) : v;
}

/// A vector multiplied by ±1/2, ±1 or ±2.
Vector multiple(Random& random, const Vector& v) {
  const double sign = random.one_in(2) ? 1 : -1;
  return std::ldexp(sign, random.integer(-1, 1)) * v;
}

/// A vector in the plane of two vectors: the sum of a multiple() of a and a multiple() of b.
Vector in_plane(Random& random, const Vector& a, const Vector& b) {
  const Vector along_a = multiple(random, a);
  return along_a + multiple(random, b);
}

// --- shape ------------------------------------------------------------------------------------------

/// Two sides that are not parallel.
std::pair<Vector, Vector> two_sides(Random& random) {
  for (;;) {
    const Vector q = small(random);
    const Vector r = small(random);
    if (!q.cross(r).isZero()) return {q, r};
  }
}

std::pair<Vector, Vector> sides(Random& random, Kind kind, Shape shape) {
  auto [q, r] = two_sides(random);
  const Vector zero = Vector::Zero();
  switch (shape) {
    case Shape::ordinary:
      return {q, r};
    case Shape::sliver: {
      const Vector across = 0x1p-10 * r;
      return {q, multiple(random, q) + across};
    }
    case Shape::needle: {
      Vector factors = Vector::Constant(0x1p-8);
      factors[random.integer(0, 2)] = 1;
      return {q.cwiseProduct(factors), r.cwiseProduct(factors)};
    }
    case Shape::tiny:
      return {0x1p-10 * q, has_triangle(kind) ? Vector(0x1p-10 * r) : r};
    case Shape::parallel:
      return {q, multiple(random, q)};
    case Shape::zero_edge:
      return {zero, r};
    case Shape::point:
      return {zero, zero};
  }
  return {q, r};
}

// --- motion and roots -------------------------------------------------------------------------------

/// Two vectors that span a plane which contains both sides, even if the sides are zero or parallel.
std::pair<Vector, Vector> plane(Random& random, const Draft& draft) {
  if (!draft.q.cross(draft.r).isZero()) return {draft.q, draft.r};
  const Vector side = draft.q.isZero() ? draft.r : draft.q;
  const Vector first = side.isZero() ? small(random) : side;
  return {first, small(random)};
}

/// The rate at which sides must shrink so that they are short at t = 1. It is a multiple of 1/16.
double shrinking(double time) {
  const double left = 1 - time;
  return left < 1.0 / 16 ? 16 : (std::ceil(16 / left) - 1) / 16;
}

/// Draws w, and makes the sides turn around an axis, shrink or stay as they are. Then F has one root, or a
/// double root at the contact, or is zero.
void turn_or_shrink(Random& random, Draft& draft, const Levels& levels, double time) {
  const bool in_the_plane = levels.roots() != Roots::one;
  const auto [a, b] = plane(random, draft);
  draft.w = in_the_plane ? in_plane(random, a, b) : small(random);
  if (levels.motion() == Motion::collapse) {
    draft.q_velocity = -shrinking(time) * draft.q;
    draft.r_velocity = -shrinking(time) * draft.r;
  } else if (levels.motion() == Motion::rotation) {
    Vector axis = small(random);
    if (levels.roots() == Roots::all) {
      axis = a.cross(b);
      const double largest = axis.cwiseAbs().maxCoeff();
      if (largest > 0) axis *= std::ldexp(1.0, -std::ilogb(largest));
    }
    draft.q_velocity = axis.cross(draft.q);
    draft.r_velocity = axis.cross(draft.r);
  }
}

/// The time of another root of F, minus the time of contact. The root is `distance` away from the contact,
/// towards the farther end of the step.
double other_time(double time, double distance) { return time < 0.5 ? distance : -distance; }

/// Draws w, and makes the sides change in any way. The points of contact pass each other at `speed` times the
/// usual speed.
void deform(Random& random, Draft& draft, Roots roots, double time, double speed) {
  const auto [a, b] = plane(random, draft);
  draft.w = speed * small(random);
  draft.q_velocity = small(random);
  draft.r_velocity = small(random);
  switch (roots) {
    case Roots::one:  // the rates are too small for the sides to become parallel
      draft.q_velocity = in_plane(random, a, b) / 16;
      draft.r_velocity = in_plane(random, a, b) / 16;
      break;
    case Roots::two:
    case Roots::three: {  // q becomes parallel to w at one time; for three roots, r does at another
      const double first = other_time(time, random.one_in(2) ? 0.5 : 0.25);
      const double second = other_time(time, 0.125);
      const Vector along = draft.w / speed;
      draft.q_velocity = (multiple(random, along) - draft.q) / first;
      draft.r_velocity = roots == Roots::three ? Vector((multiple(random, along) - draft.r) / second)
                                               : Vector(Vector::Zero());
      break;
    }
    case Roots::double_root:
      if (!draft.q.cross(draft.r).isZero()) draft.w = speed * in_plane(random, a, b);
      break;
    case Roots::triple:
      if (draft.q.isZero() && draft.r.isZero()) break;
      draft.w = speed * multiple(random, a);
      if (!draft.q.cross(draft.r).isZero()) draft.q_velocity = in_plane(random, a, b);
      break;
    case Roots::all:
      draft.w = speed * in_plane(random, a, b);
      draft.q_velocity = in_plane(random, a, b);
      draft.r_velocity = in_plane(random, a, b);
  }
}

Draft draft_of(Random& random, Kind kind, const Levels& levels, double time) {
  const Vector zero = Vector::Zero();
  const auto [q, r] = sides(random, kind, levels.shape());
  Draft draft{q, r, zero, zero, zero};
  switch (levels.motion()) {
    case Motion::rest:
      break;
    case Motion::translation:
    case Motion::rotation:
    case Motion::collapse:
      turn_or_shrink(random, draft, levels, time);
      break;
    case Motion::fast:
      deform(random, draft, levels.roots(), time, 0x1p10);
      break;
    case Motion::slow:
      deform(random, draft, levels.roots(), time, 0x1p-10);
      break;
    case Motion::along:  // has_roots() allows only roots for which deform() puts w into the plane
    case Motion::deforming:
      deform(random, draft, levels.roots(), time, 1);
  }
  return draft;
}

/// Whether F has no more roots at the contact than planned. Let F = τ (a + b τ + c τ²). By construction, a is
/// zero for a double root, and a and b are zero for a triple root. The next coefficient must not be zero by
/// chance.
bool has_planned_roots(const Draft& draft, Roots roots) {
  const auto det = [&](const Vector& q, const Vector& r) { return draft.w.dot(q.cross(r)); };
  switch (roots) {
    case Roots::all:
      return true;
    case Roots::double_root:
      return det(draft.q_velocity, draft.r) + det(draft.q, draft.r_velocity) != 0;
    case Roots::triple:
      return det(draft.q_velocity, draft.r_velocity) != 0;
    default:
      return det(draft.q, draft.r) != 0;
  }
}

// --- place and time ---------------------------------------------------------------------------------

/// The weights of the point of contact. They are multiples of 1/16; but if the point must be outside, one
/// weight is beyond its limit by 2^-10 to 2^-52.
std::pair<double, double> weights(Random& random, Kind kind, Where where) {
  const bool is_edges = !has_triangle(kind);
  const int first = random.integer(1, is_edges ? 15 : 14);
  const int second = random.integer(1, is_edges ? 15 : 15 - first);
  const double alpha = first / 16.0;
  const double beta = second / 16.0;
  const double end = random.integer(0, 1);
  const bool swaps = random.one_in(2);
  const auto swapped = [&](double a, double b) { return swaps ? std::pair{b, a} : std::pair{a, b}; };
  switch (where) {
    case Where::inside:
      return {alpha, beta};
    case Where::edge:
      if (is_edges) return swapped(alpha, end);
      return random.one_in(3) ? std::pair{alpha, 1 - alpha} : swapped(alpha, 0);
    case Where::vertex:
      if (is_edges) return {end, random.integer(0, 1)};
      return swapped(end, 0);
    case Where::outside: {
      const double beyond = std::ldexp(1.0, -random.integer(10, 52));
      if (random.one_in(2)) return swapped(alpha, -beyond);
      return swapped(alpha, (is_edges ? 1 : 1 - alpha) + beyond);
    }
  }
  return {alpha, beta};
}

/// The time of contact. The contact stays exact if the time has at most `bits` binary places.
double time_of(Random& random, When when, int bits) {
  switch (when) {
    case When::at_0:
      return 0;
    case When::after_0:
      return std::ldexp(1.0, -random.integer(5, bits));
    case When::inside:
      return random.integer(1, 15) / 16.0;
    case When::before_1:
      return 1 - std::ldexp(1.0, -random.integer(5, bits));
    case When::at_1:
      return 1;
    case When::outside: {
      const double beyond = std::ldexp(1.0, -random.integer(5, 52));
      return random.one_in(2) ? -beyond : 1 + beyond;
    }
  }
  return 0;
}

/// The smaller of `lowest` and the exponent of the lowest bit that is set in any component of v.
int lowest_bit(const Vector& v, int lowest) {
  for (const double c : v) {
    if (c == 0) continue;
    int exponent = 0;
    const double mantissa = std::frexp(std::abs(c), &exponent);
    const auto bits = static_cast<std::uint64_t>(std::ldexp(mantissa, 53));
    lowest = std::min(lowest, exponent - 53 + std::countr_zero(bits));
  }
  return lowest;
}

/// The place of contact, and the velocity that all vertices have in common.
struct Frame {
  Vector place, velocity;
};

Frame frame_of(Random& random, std::size_t offset) {
  const double distance = std::array<double, 3>{0, 0x1p2, 0x1p8}[offset];
  const Vector place = distance * small(random);
  return {place, random.one_in(2) ? small(random) : Vector(Vector::Zero())};
}

/// The largest number of binary places that the time of contact may have if all coordinates are to be exact.
/// Every coordinate is a sum of products of a vector's component, a time and a weight. A weight has four
/// binary places.
int bits_for_time(const Draft& draft, const Frame& frame) {
  int lowest = 0;
  double sum = 0;
  for (const Vector* v :
       {&draft.q, &draft.r, &draft.q_velocity, &draft.r_velocity, &draft.w, &frame.place, &frame.velocity}) {
    lowest = lowest_bit(*v, lowest);
    sum += 2 * v->cwiseAbs().maxCoeff();
  }
  if (sum == 0) return 52;
  return 53 - 4 - (std::ilogb(sum) + 1) + lowest;
}

/// Sets the positions of the vertices at the time `tau` after the contact.
void set_positions(Query& query, bool at_start, const Draft& draft, const Frame& frame,
                   std::pair<double, double> weight, double tau) {
  const auto [alpha, beta] = weight;
  const bool is_edges = !has_triangle(query.kind);
  const Vector q = draft.q + tau * draft.q_velocity;
  const Vector r = draft.r + tau * draft.r_velocity;
  const Vector middle = frame.place + tau * frame.velocity;
  const auto set = [&](int vertex, const Vector& place) {
    if (at_start)
      query.set_start(vertex, place);
    else
      query.set_end(vertex, place);
  };
  // The second primitive's point of contact has the velocity that all vertices share (Frame).
  const Vector base = middle - beta * r - (is_edges ? Vector(Vector::Zero()) : Vector(alpha * q));
  const Vector point = middle + tau * draft.w;
  set(0, is_edges ? Vector(point - alpha * q) : point);
  set(1, is_edges ? Vector(point + (1 - alpha) * q) : base);
  set(2, is_edges ? base : Vector(base + q));
  set(3, base + r);
}

}  // namespace

Query make_query(Random& random, Kind kind, const Levels& levels) {
  constexpr int fewest_bits = 5;
  for (;;) {
    const Frame frame = frame_of(random, levels.offset());
    // The draft depends on the time of contact, and the number of bits that this time may have depends on the
    // draft. So the draft is made for a time with few bits that is near the time of contact.
    const double near = time_of(random, levels.when(), fewest_bits);
    const Draft draft = draft_of(random, kind, levels, near);
    const auto weight = weights(random, kind, levels.where());
    const int bits = bits_for_time(draft, frame);
    if (bits < fewest_bits || !has_planned_roots(draft, levels.roots())) continue;
    const bool is_near_end = levels.when() == When::after_0 || levels.when() == When::before_1;
    const double time = is_near_end ? time_of(random, levels.when(), bits) : near;
    Query query{.kind = kind};
    set_positions(query, true, draft, frame, weight, -time);
    set_positions(query, false, draft, frame, weight, 1 - time);
    const double scale = power_of_ten(3.0 * (levels.scale() - 2));
    for (double& c : query.x) c *= scale;
    return shuffled(random, query);
  }
}

}  // namespace nearmiss::crossed

namespace nearmiss {

std::vector<Family> crossed_families() {
  return {{.name = "crossed",
           .about = "every combination of shape, motion, time, place, roots of F, scale and offset",
           .make =
               [](Random& random, Kind kind) {
                 const crossed::Levels levels = crossed::draw_levels(random);
                 return crossed::make_query(random, kind, levels);
               },
           .factors = [](Random& random) { return crossed::to_texts(crossed::draw_levels(random)); }}};
}

}  // namespace nearmiss
