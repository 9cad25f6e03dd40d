// Families of primitives that touch exactly: at t = 0 or t = 1, just after t = 0, at rest, or at two times. x
// is the family's parameter, and F is the coplanarity cubic.
#include <algorithm>
#include <array>
#include <cmath>

#include "fuzz/families/contacts.hpp"
#include "fuzz/families/tables.hpp"

namespace nearmiss {

namespace {

using Vector = Vector3<double>;

// --- contact at an end of a long motion ---------------------------------------------------------------

Vector wide_vector(Random& random, int bits) {
  const Vector v = random.vector(std::ldexp(1.0, bits));
  return v.array().floor();
}

/// Primitives at rest that touch exactly; half of the queries touch at a vertex. Rounding errors matter most
/// at a vertex: both weights are at the ends of their ranges, so if an error moves the vertex away, no
/// neighbouring point of the primitive touches in its place. Coordinates are multiples of 1/16 below 2^48, so
/// they use nearly all bits of a double.
Query touching_at_rest(Random& random, Kind kind) {
  Contact contact = integer_contact(random, kind);
  contact.base = still(wide_vector(random, 46));
  contact.q = still(wide_vector(random, 45));
  contact.r = still(wide_vector(random, 45));
  if (random.one_in(2)) {
    contact.alpha = random.integer(0, 1);
    contact.beta = random.integer(0, !has_triangle(kind) || contact.alpha == 0 ? 1 : 0);
  }
  return meet(kind, contact, Vector::Zero());
}

/// Primitives of size 10^x that touch exactly at t = 1. At t = 0, they are up to about 1,024 times their size
/// away from their places at t = 1; they change their shape on the way. The difference between a vertex's
/// positions at t = 0 and at t = 1 has more bits than a double. A CCD that computes positions at t = 1 from
/// this difference misses the contact unless it allows for rounding errors. In three queries of four, both
/// primitives are flat along an axis at all times, like a garment that falls onto a floor.
Query far_end(Random& random, Kind kind, double x) {
  const double size = power_of_ten(x);
  Query query = touching_at_rest(random, kind);
  for (double& c : query.x) c *= size * 0x1p-45;
  const bool flat = !random.one_in(4);
  const Vector axis = Vector::Unit(random.integer(0, 2));
  const Vector kept = flat ? Vector(Vector::Ones() - axis) : Vector::Ones();
  const double far = std::ldexp(size, random.integer(0, 10));
  const Vector first = random.vector(far);
  const double slow = random.one_in(2) ? far : size;
  const Vector second = random.vector(slow);
  const Vector height = flat ? Vector(random.vector(size).cwiseProduct(axis)) : Vector::Zero();
  for (int i = 0; i < 4; ++i) {
    const Vector& away = i < split(kind) ? first : second;
    query.set_end(i, query.end(i).cwiseProduct(kept) + height);
    query.set_start(i, query.end(i) + away + random.vector(size / 8).cwiseProduct(kept));
  }
  return shuffled(random, query);
}

Query far_start(Random& random, Kind kind, double x) {
  Query query = far_end(random, kind, x);
  std::rotate(query.x.begin(), query.x.begin() + 12, query.x.end());
  return query;
}

// --- contact hardly after t = 0 -------------------------------------------------------------------------

/// The second primitive always contains the origin. The first primitive's point of contact moves from -2^x w
/// to w, and is at the origin at t = 2^x / (1 + 2^x). If w is in the plane of the primitives, they may touch
/// earlier. If the first primitive is an edge, it has no extent along the axis along which it moves, so that
/// adding a tiny number to its coordinates is exact.
Query first_moment(Random& random, Kind kind, double x) {
  Contact contact = integer_contact(random, kind);
  const Vector axis = Vector::Unit(random.integer(0, 2));
  const bool along_axis = !has_triangle(kind) || random.one_in(2);
  if (!has_triangle(kind))
    for (Vector* const side : {&contact.q.start, &contact.q.end}) *side -= side->cwiseProduct(axis);
  const auto place = [&](const Vector& q, const Vector& r) -> Vector {
    if (!has_triangle(kind)) return contact.beta * r;
    return contact.alpha * q + contact.beta * r;
  };
  contact.base = {-place(contact.q.start, contact.r.start), -place(contact.q.end, contact.r.end)};
  const int speed = 1 << random.integer(0, 16);
  Vector w = random.integer_vector(speed);
  if (along_axis || w.isZero()) w = (random.one_in(2) ? speed : -speed) * axis;

  contact.time = 0;  // before the motion below is added, the points of contact stay at the origin
  Query query = meet(kind, contact, Vector::Zero());
  for (int i = 0; i < split(kind); ++i) {
    query.set_start(i, query.start(i) - power_of_two(x) * w);
    query.set_end(i, query.end(i) + w);
  }
  const double scale = std::ldexp(1.0, random.integer(-20, 20));
  for (double& c : query.x) c *= scale;
  return shuffled(random, query);
}

// --- no motion and no size ------------------------------------------------------------------------------

/// All vertices of a primitive are one point at rest. Either both primitives are the same point, or one
/// coordinate of the second primitive's point differs from that of the first primitive's point by up to four
/// ulps. In these queries, an error bound that is proportional to sizes or motions is 0.
Query one_point(Random& random, Kind kind) {
  const double size = power_of_ten(random.uniform(-3, 3));
  const Vector point = random.vector(size);
  Vector other = point;
  if (random.one_in(2)) {
    const int sign = random.one_in(2) ? 1 : -1;
    double& c = other[random.integer(0, 2)];
    c = moved_by_ulps(c, sign * random.integer(1, 4));
  }
  Query query{.kind = kind};
  for (int i = 0; i < 4; ++i) {
    query.set_start(i, i < split(kind) ? point : other);
    query.set_end(i, i < split(kind) ? point : other);
  }
  return query;
}

// --- contact twice --------------------------------------------------------------------------------------

/// Two vertices of one primitive pass through a vertex v of the other primitive, each at its own time:
/// relative to v, they are at (t - i / 16) a and (t - j / 16) b. F is (t - i / 16) (t - j / 16) det(a, b,
/// c(t)), where c(t) is the vector from v to the fourth vertex. In one query of four, all vertices are in one
/// plane, and F is zero.
Query touch_twice(Random& random, Kind kind) {
  const int size = 1 << random.integer(1, 16);
  const bool flat = random.one_in(4);
  const Vector axis = Vector::Unit(random.integer(0, 2));
  const auto draw = [&]() -> Vector {
    const Vector v = random.integer_vector(size);
    return flat ? Vector(v - v.cwiseProduct(axis)) : v;
  };
  const Vector a = draw();
  const Vector b = draw();
  const double first = random.integer(0, 16) / 16.0;
  const double second = random.integer(0, 16) / 16.0;
  const Path corner = passing(Vector::Zero(), a, first);
  const Path other = passing(Vector::Zero(), b, second);
  const Vector c_start = draw();
  const Vector c_end = random.one_in(2) ? c_start : draw();
  const Path vertex{random.integer_vector(size), random.integer_vector(size)};
  const Path rest = still(Vector::Zero());
  const Path third{c_start, c_end};

  Query query{.kind = kind};
  const std::array<Path, 4> paths =
      has_triangle(kind) ? std::array{rest, corner, other, third} : std::array{corner, other, rest, third};
  for (int i = 0; i < 4; ++i) {
    const Path& path = paths[static_cast<std::size_t>(i)];
    query.set_start(i, vertex.start + path.start);
    query.set_end(i, vertex.end + path.end);
  }
  return placed(random, query);
}

}  // namespace

std::vector<Family> motion_families() {
  return {
      with_collisions(with_parameter("far-end", "exact contact at t = 1, after a long motion",
                                     {"size of the primitives = 10^x", -6, 6, false, far_end})),
      with_collisions(with_parameter("far-start", "exact contact at t = 0, before a long motion",
                                     {"size of the primitives = 10^x", -6, 6, false, far_start})),
      with_collisions(with_parameter(
          "first-moment", "exact contact at t < 2^-49; one query in a hundred touches at t = 0, too",
          {"contact is at about t = 2^x", -110, -50, true, first_moment})),
      {.name = "one-point",
       .about = "each primitive is one point at rest, the same or up to four ulps apart",
       .make = one_point},
      {.name = "touch-twice",
       .about = "two corners of one primitive pass the same vertex of the other, at two times",
       .planted = true,
       .make = touch_twice},
  };
}

}  // namespace nearmiss
