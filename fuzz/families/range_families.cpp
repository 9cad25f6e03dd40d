// Families in which products of coordinates are at the ends of the range of double. No coordinate overflows
// or underflows, but products of two, three, four or six differences of coordinates, or sums of such
// products, overflow or underflow. A CCD computes the weights of a point of contact from a vector W, whose
// components are sums of products of two differences. F, the coplanarity cubic, is a sum of products of three
// differences. The square of W is a sum of products of four differences, and the square of F is a sum of
// products of six differences. A query is first made of small numbers; then its vertices and axes are scaled
// by powers of two, which is exact.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "fuzz/families/contacts.hpp"
#include "fuzz/families/tables.hpp"

namespace nearmiss {

namespace {

using Vector = Vector3<double>;

// --- queries of small numbers -----------------------------------------------------------------------

struct Draft {
  Query query;
  bool scales_vertices = false;  ///< whether scaled_to() may scale single vertices
};

/// Exact contact inside the triangle, on an edge or at a vertex, at any time of the step including its ends.
/// One contact in three is tangential.
Draft touching(Random& random, Kind kind) {
  Contact contact = integer_contact(random, kind);
  const bool at_origin = random.one_in(2);
  if (at_origin) move_to_origin(kind, contact, random.integer_vector(random.integer(0, 1) << 4));
  Vector w = random.integer_vector(1 << random.integer(0, 16));
  if (random.one_in(3)) {
    const Vector along_r = random.integer(-4, 4) / 4.0 * contact.r.at(contact.time);
    const Vector in_plane = random.integer(-4, 4) / 4.0 * contact.q.at(contact.time) + along_r;
    w = contact.velocity(kind) + in_plane;
  }
  return {meet(kind, contact, w), at_origin};
}

/// Exact contact of small integers, at the origin and inside the step. Speeds are as large as the sizes of
/// the primitives, so the primitives are usually apart at the other roots of F.
Draft small_touching(Random& random, Kind kind) {
  const auto path = [&] {
    const Vector start = random.integer_vector(2);
    return Path{start, random.integer_vector(2)};
  };
  const int eighths = random.integer(0, 8);
  const int left = has_triangle(kind) ? 8 - eighths : 8;
  Contact contact;
  contact.alpha = eighths / 8.0;
  contact.beta = random.integer(0, left) / 8.0;
  contact.time = random.integer(1, 15) / 16.0;
  contact.q = path();
  contact.r = path();
  move_to_origin(kind, contact, random.integer_vector(2));
  return {meet(kind, contact, random.integer_vector(random.integer(1, 4))), true};
}

/// A query of small integers; in one of four queries, one primitive is at rest.
Query lattice(Random& random, Kind kind) {
  const int size = random.integer(1, 4);
  Query query{.kind = kind};
  for (double& c : query.x) c = random.integer(-size, size);
  if (random.one_in(4)) {
    const bool first = random.one_in(2);
    for (int i = first ? 0 : split(kind); i < (first ? split(kind) : 4); ++i)
      query.set_end(i, query.start(i));
  }
  return query;
}

/// Integer points next to a plane that is oblique to the axes. The products in F are then far larger than
/// their sum, and F often changes its sign.
Query oblique(Random& random, Kind kind) {
  const Vector P = random.integer_vector(2);
  const Vector Q = random.integer_vector(2);
  Query query{.kind = kind};
  for (int i = 0; i < 4; ++i) {
    const auto point = [&]() -> Vector {
      const Vector along_P = random.integer(-3, 3) * P;
      const Vector in_plane = along_P + random.integer(-3, 3) * Q;
      return in_plane + random.integer_vector(random.integer(0, 1));
    };
    query.set_start(i, point());
    query.set_end(i, point());
  }
  return query;
}

Query cube(Random& random, Kind kind) {
  Query query{.kind = kind};
  for (double& c : query.x) c = random.uniform(-1, 1);
  return query;
}

/// Contact at the origin. A weight or the time may be outside [0, 1], by a power of two that may be as small
/// as ε.
Draft aimed(Random& random, Kind kind) {
  ContactSampler sampler(random);
  Contact contact = sampler.contact(kind, sampler.speed());
  move_to_origin(kind, contact, sampler.velocity());
  return {meet(kind, contact, sampler.velocity()), true};
}

Draft any_contact(Random& random, Kind kind) {
  return random.one_in(2) ? touching(random, kind) : small_touching(random, kind);
}

Draft any_draft(Random& random, Kind kind) {
  switch (random.integer(0, 5)) {
    case 0:
      return {lattice(random, kind), random.one_in(2)};
    case 1:
      return {oblique(random, kind), random.one_in(2)};
    case 2:
      return {cube(random, kind), random.one_in(2)};
    case 3:
      return aimed(random, kind);
    default:
      return any_contact(random, kind);
  }
}

// --- sizes ------------------------------------------------------------------------------------------

/// For v = 1, 2, 3 and each axis, the magnitude of the component of x_v - x_0 along the axis, at t = 0 or at
/// t = 1, whichever is larger.
using Differences = std::array<std::array<double, 3>, 3>;

Differences differences(const Query& query) {
  Differences larger{};
  for (int v = 1; v < 4; ++v) {
    const Vector start = query.start(v) - query.start(0);
    const Vector end = query.end(v) - query.end(0);
    for (int k = 0; k < 3; ++k)
      larger[static_cast<std::size_t>(v - 1)][static_cast<std::size_t>(k)] =
          std::max(std::abs(start[k]), std::abs(end[k]));
  }
  return larger;
}

constexpr std::size_t none = 3;  ///< stands for no axis

/// The sum of the magnitudes of the products in F. Each product has three factors: a difference along each
/// axis. If an axis is left out, returns the sum for the products in W's component along that axis instead;
/// each of these products has two factors.
double sum_of_products(const Query& query, std::size_t left_out) {
  const Differences d = differences(query);
  double sum = 0;
  std::array<std::size_t, 3> axis{0, 1, 2};
  do {
    double product = 1;
    for (std::size_t v = 0; v < 3; ++v) product *= axis[v] == left_out ? 1 : d[v][axis[v]];
    sum += product;
  } while (std::next_permutation(axis.begin(), axis.end()));
  return sum;
}

void scale_axis(Query& query, std::size_t axis, int exponent) {
  for (std::size_t i = axis; i < 24; i += 3) query.x[i] = std::ldexp(query.x[i], exponent);
}

/// Multiplies the coordinates along an axis by the largest multiple of 1/8 that does not change the exponent
/// of the sum of products. Then the sum is near the top of its binade; if its exponent is 1023, two or three
/// times the sum overflows.
void fill_binade(Query& query, std::size_t axis, double sum) {
  const double mantissa = std::ldexp(sum, -std::ilogb(sum));
  const double factor = (std::ceil(16 / mantissa) - 1) / 8;
  for (std::size_t i = axis; i < 24; i += 3) query.x[i] *= factor;
}

/// Scales the coordinates along the axes that are not left out, so that the sum of products is in [2^x, 2^(x
/// + 1)), unless it is zero. If `spread` is 0, the exponents of the axes' factors differ by at most 1;
/// otherwise, they differ by random numbers of about the size of `spread`.
void scale_products(Random& random, Query& query, std::size_t left_out, int x, int spread) {
  const double sum = sum_of_products(query, left_out);
  int exponent = x;
  if (sum != 0) {
    exponent -= std::ilogb(sum);
    if (!random.one_in(4)) fill_binade(query, (left_out + 1) % 3, sum);
  }
  const auto first = static_cast<std::size_t>(random.integer(0, 2));
  int axes = left_out == none ? 3 : 2;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t axis = (first + i) % 3;
    if (axis == left_out) continue;
    const int part = axes > 1 ? exponent / axes + random.integer(-spread, spread) : exponent;
    scale_axis(query, axis, part);
    exponent -= part;
    --axes;
  }
}

/// Makes the coordinates of two vertices up to 2^512 times larger or smaller than those of the other two
/// vertices, or multiplies the coordinates of each vertex by a power of two of its own.
void scale_vertices(Random& random, Query& query) {
  const int half = random.integer(-256, 256);
  std::array<int, 4> exponents{-half, -half, half, half};
  if (random.one_in(2)) std::swap(exponents[1], exponents[2]);
  if (random.one_in(2))
    for (int& exponent : exponents) exponent = random.integer(-100, 100);
  for (std::size_t i = 0; i < 24; ++i) query.x[i] = std::ldexp(query.x[i], exponents[i / 3 % 4]);
}

/// Scales two axes so that the products of two differences in a component of W add up to about 2^x. Scales
/// the third axis so that F also overflows or underflows, or so that F stays inside the range of double.
void scale_products_of_two(Random& random, Query& query, int x, int spread) {
  const auto left_out = static_cast<std::size_t>(random.integer(0, 2));
  scale_products(random, query, left_out, x, spread);
  const int inward = random.integer(0, 60);
  scale_axis(query, left_out, random.one_in(4) ? x / 2 : x > 0 ? -inward : inward);
}

/// Scales a draft so that products of two, three, four or six differences add up to about 2^x. In half of the
/// queries, all coordinates have about the same size. In the other half, the vertices or the axes have
/// different sizes.
Query scaled_to(Random& random, const Draft& draft, int x) {
  Query query = shuffled(random, draft.query);
  const bool mixed = random.one_in(2);
  const bool by_vertex = mixed && draft.scales_vertices;
  if (by_vertex) scale_vertices(random, query);
  const int spread = mixed && !by_vertex ? 200 : 0;
  const int half = static_cast<int>(std::floor(x / 2.0));
  const int sort = random.integer(0, 7);
  if (sort < 2)
    scale_products_of_two(random, query, x, spread);
  else if (sort == 2)
    scale_products_of_two(random, query, half, spread);
  else
    scale_products(random, query, none, sort == 3 ? half : x, spread);
  return query;
}

// --- families ---------------------------------------------------------------------------------------

Query planted_contact(Random& random, Kind kind, double x) {
  const Draft draft = any_contact(random, kind);
  return scaled_to(random, draft, static_cast<int>(x));
}

Query any(Random& random, Kind kind, double x) {
  const Draft draft = any_draft(random, kind);
  const Query query = scaled_to(random, draft, static_cast<int>(x));
  return random.one_in(8) ? nudged(random, query, random.integer(1, 4), 4) : query;
}

Family family(std::string name, std::string about, bool is_planted, Parameter parameter) {
  Family made = with_parameter(std::move(name), std::move(about), std::move(parameter));
  made.planted = is_planted;
  made.compare_all = true;
  made.block_cases = 1;  // exact arithmetic is slow
  return made;
}

}  // namespace

std::vector<Family> range_families() {
  const std::string about = "products of 2, 3, 4 or 6 differences of coordinates add up to about 2^x";
  return {
      family("near-overflow", "products of coordinates, or their sums, overflow, or nearly so", false,
             {about, 1016, 1025, true, any}),
      family("near-overflow-planted", "the same, in exact contact", true,
             {about, 1016, 1025, true, planted_contact}),
      family("near-underflow", "products of coordinates become subnormal or zero, or nearly so", false,
             {about, -1090, -1006, true, any}),
      family("near-underflow-planted", "the same, in exact contact", true,
             {about, -1090, -1006, true, planted_contact}),
  };
}

}  // namespace nearmiss
