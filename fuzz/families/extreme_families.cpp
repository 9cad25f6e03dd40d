// Families with sizes, speeds, angles and places at the limits of double. Vectors are scaled by powers of
// two, so exact contacts stay exact. x is the family's parameter.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "fuzz/families/contacts.hpp"
#include "fuzz/families/tables.hpp"

namespace nearmiss {

namespace {

using Vector = Vector3<double>;

// --- sizes and speeds -------------------------------------------------------------------------------

/// The first primitive has the speed 10^x. In some queries, the second primitive has this speed, too, or the
/// shapes change at this speed.
Query stiff(Random& random, Kind kind, double x) {
  const double speed = power_of_ten(x);
  ContactSampler sampler(random);
  const double slow = std::min(speed, sampler.speed());
  Contact contact = sampler.contact(kind, random.one_in(4) ? speed : slow);
  const double base_speed = random.one_in(4) ? speed : slow;
  move_to_origin(kind, contact, base_speed * sampler.vector());
  return finished(random, meet(kind, contact, speed * sampler.direction()));
}

/// One of the sides q and r is shorter than the other. In half of the queries, the contact is near the
/// triangle's corner x1 (vertex-triangle) or near an end of the long edge (edge-edge): the distance from the
/// contact to this corner or end is at most about the length of the short side.
Query aspect(Random& random, Kind kind, double x) {
  const double size = power_of_ten(-x);
  ContactSampler sampler(random);
  Contact contact = sampler.contact(kind, sampler.speed());
  const bool short_q = random.one_in(2);
  Path& side = short_q ? contact.q : contact.r;
  side = scaled(side, size);
  if (random.one_in(2)) (short_q ? contact.beta : contact.alpha) *= size;
  const double speed = random.one_in(2) ? size : sampler.fraction(52);
  move_to_origin(kind, contact, random.one_in(2) ? Vector(Vector::Zero()) : speed * sampler.vector());
  return finished(random, meet(kind, contact, speed * sampler.direction()));
}

Query offset(Random& random, Kind kind, double x) {
  ContactSampler sampler(random);
  Contact contact = sampler.contact(kind, sampler.speed());
  move_to_origin(kind, contact, sampler.velocity());
  const Query query = meet(kind, contact, sampler.velocity());
  return finished(random, moved(query, power_of_ten(x) * sampler.direction()));
}

Query scale(Random& random, Kind kind, double x) {
  ContactSampler sampler(random);
  Contact contact = sampler.contact(kind, sampler.speed());
  move_to_origin(kind, contact, sampler.velocity());
  Query query = finished(random, meet(kind, contact, sampler.velocity()));
  double largest = 0;
  for (const double c : query.x) largest = std::max(largest, std::abs(c));
  if (largest == 0) return query;
  const int exponent = static_cast<int>(x) - std::ilogb(largest);
  for (double& c : query.x) c = std::ldexp(c, exponent);
  return query;
}

/// Coordinates are small integers, multiplied by 2^1022 along one axis or along random axes. Along these
/// axes, many differences of coordinates overflow. Most primitives start in a plane normal to such an axis,
/// and half of the coordinates are at rest.
Query overflow(Random& random, Kind kind) {
  Query query{.kind = kind};
  const auto first_vertices = static_cast<std::size_t>(split(kind));
  // The only axis along which coordinates are huge. If `only` is 3 or more, they may be huge along any axis.
  const int only = random.integer(0, 5);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool huge = only < 3 ? static_cast<int>(axis) == only : random.one_in(2);
    const double size = huge ? 0x1p1022 : 1;
    const int most = huge ? 3 : random.integer(1, 3);
    const bool flat = huge && !random.one_in(4);
    for (std::size_t vertex = 0; vertex < 4; ++vertex) {
      double& start = query.x[3 * vertex + axis];
      const bool beside_last = flat && vertex != 0 && vertex != first_vertices;
      start = beside_last ? query.x[3 * (vertex - 1) + axis] : size * random.integer(-most, most);
      query.x[3 * (vertex + 4) + axis] = random.one_in(2) ? start : size * random.integer(-most, most);
    }
  }
  return finished(random, query);
}

/// Each vertex and each axis has its own power of two, by which coordinates are multiplied. The primitives
/// touch at the origin. So they still touch after all coordinates of a vertex, or all coordinates along an
/// axis, have been multiplied by a positive number.
Query mixed_scale(Random& random, Kind kind, double x) {
  ContactSampler sampler(random);
  Contact contact = sampler.contact(kind, sampler.speed());
  move_to_origin(kind, contact, sampler.velocity());
  Query query = meet(kind, contact, sampler.velocity());
  const int most = static_cast<int>(x) / 4;
  std::array<int, 3> axis{};
  for (int& exponent : axis) exponent = random.integer(-most, most);
  for (std::size_t vertex = 0; vertex < 4; ++vertex) {
    const int own = random.integer(-most, most);
    for (const std::size_t point : {vertex, vertex + 4})
      for (std::size_t k = 0; k < 3; ++k)
        query.x[3 * point + k] = std::ldexp(query.x[3 * point + k], own + axis[k]);
  }
  return finished(random, query);
}

/// One primitive is exactly at rest; the other has the speed 10^x.
Query static_pair(Random& random, Kind kind, double x) {
  const double speed = power_of_ten(x);
  ContactSampler sampler(random);
  const double slow = std::min(speed, sampler.speed());
  Contact contact = sampler.contact(kind, slow);
  const auto rest = [](Path& path, double time) { path = passing(path.at(time), Vector::Zero(), time); };
  const bool first_moves = random.one_in(2);
  if (has_triangle(kind) == first_moves) rest(contact.q, contact.time);
  if (first_moves) rest(contact.r, contact.time);
  const Vector fast = speed * sampler.direction();
  const Vector none = Vector::Zero();
  move_to_origin(kind, contact, first_moves ? none : fast);
  return finished(random, meet(kind, contact, first_moves ? fast : none));
}

// --- directions -------------------------------------------------------------------------------------

/// Edge-edge: the second edge is nearly a multiple of the first edge, q. Vertex-triangle: the velocity of the
/// vertex relative to the triangle is nearly a multiple of the side q.
Query near_parallel(Random& random, Kind kind, double x) {
  const double angle = power_of_ten(x);
  ContactSampler sampler(random);
  Contact contact = sampler.contact(kind, 0);
  if (random.one_in(2)) contact.q = passing(sampler.direction(), Vector::Zero(), 0);
  const double sign = random.one_in(2) ? 1 : -1;
  const double along = std::ldexp(sign, random.integer(-2, 1));
  const Vector nearly = along * contact.q.start + angle * sampler.vector();
  Vector w = sampler.velocity();
  if (!has_triangle(kind))
    contact.r = {nearly, nearly};
  else
    w = nearly;
  move_to_origin(kind, contact, sampler.velocity());
  return finished(random, meet(kind, contact, contact.velocity(kind) + w));
}

/// The rotation about `axis` by the angle 2 atan(size / 2). If `size` is small, this angle is about `size`.
Eigen::Matrix3d rotation(const Vector& axis, double size) {
  const double length = axis.norm();
  const Vector part = (length == 0 ? 0 : size / 2 / length) * axis;
  return Eigen::Quaterniond(1, part[0], part[1], part[2]).normalized().toRotationMatrix();
}

/// The primitives are long along one axis, and thin along the others; in half of the queries, their relative
/// motion is stretched in the same way. One query in three is rotated.
Query needle(Random& random, Kind kind, double x) {
  const double thin = power_of_ten(x);
  ContactSampler sampler(random);
  Vector factors = Vector::Constant(thin);
  factors[random.integer(0, 2)] = 1;
  const auto squeezed = [&](const Vector& v) -> Vector { return v.cwiseProduct(factors); };
  Contact contact = sampler.contact(kind, sampler.speed());
  for (Path* const side : {&contact.q, &contact.r}) *side = {squeezed(side->start), squeezed(side->end)};
  move_to_origin(kind, contact, squeezed(sampler.velocity()));
  const Vector w = sampler.velocity();
  Query query = meet(kind, contact, random.one_in(2) ? squeezed(w) : w);
  if (random.one_in(3)) {
    const Eigen::Matrix3d turn = rotation(random.vector(1), 2);
    for (int i = 0; i < 4; ++i) {
      query.set_start(i, turn * query.start(i));
      query.set_end(i, turn * query.end(i));
    }
  }
  return finished(random, query);
}

/// One rotation takes both primitives from their places at t = 0 to their places at t = 1; between these
/// times, each vertex moves in a straight line. So for every time, one affine map takes both primitives from
/// their places at t = 0 to their places at that time. In this motion, points that coincide once coincide at
/// all times. Then a relative motion, `apart`, is added, and only this motion separates the primitives.
Query rigid(Random& random, Kind kind, double x) {
  const Eigen::Matrix3d turn = rotation(random.vector(1), power_of_ten(x));
  const auto turned = [&](const Vector& v) { return Path{v, turn * v}; };
  ContactSampler sampler(random);
  Contact contact = sampler.contact(kind, 0);
  contact.q = turned(contact.q.start);
  contact.r = turned(contact.r.start);
  const double away = std::ldexp(1.0, random.integer(0, 6));  // distance from the axis of rotation
  contact.base = turned(away * sampler.vector());
  if (random.one_in(2)) contact.base.end += sampler.vector();
  const double speed = sampler.fraction(52);
  const Vector apart = speed * sampler.direction();
  return finished(random, meet(kind, contact, contact.velocity(kind) + apart));
}

}  // namespace

std::vector<Family> extreme_families() {
  return {
      with_parameter("stiff", "motion far smaller or larger than the primitives",
                     {"speed / size of the primitives = 10^x", -16, 16, false, stiff}),
      with_parameter("aspect", "long and short edges",
                     {"ratio of the edges' lengths = 10^x", 0, 16, false, aspect}),
      with_parameter("offset", "primitives far from the origin",
                     {"distance / size of the primitives = 10^x", 0, 16, false, offset}),
      with_parameter("scale", "subnormal to nearly overflowing",
                     {"largest coordinate is from 2^x to 2^(x + 1)", -1074, 1023, true, scale}),
      {.name = "overflow",
       .about = "differences of coordinates overflow, along some axes",
       .make = overflow,
       .block_cases = 3},  // exact arithmetic is slow
      with_parameter("mixed-scale", "every vertex and every axis has an exponent of its own",
                     {"the exponents, to base 2, are within x of each other", 0, 2000, true, mixed_scale}),
      with_parameter("near-parallel-edges",
                     "an edge nearly parallel to the other, or motion nearly parallel to a triangle's edge",
                     {"angle = 10^x", -16, 0, false, near_parallel}),
      with_parameter("needle", "long thin primitives", {"height / length = 10^x", -16, 0, false, needle}),
      with_parameter("static-pair", "one primitive rests",
                     {"speed of the other / size of the primitives = 10^x", -16, 16, false, static_pair}),
      with_parameter("rigid", "both primitives turn together, and move a little apart",
                     {"angle of the rotation = 2 atan(10^x / 2)", -16, 2, false, rigid}),
  };
}

}  // namespace nearmiss
