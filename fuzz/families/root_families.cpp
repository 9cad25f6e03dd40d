// Families in which the roots of F, the coplanarity cubic, are hard to find: roots at the ends of the step,
// pairs of roots close to each other, and triple roots. x is the family's parameter.
#include <algorithm>
#include <cmath>

#include "fuzz/families/contacts.hpp"
#include "fuzz/families/tables.hpp"

namespace nearmiss {

namespace {

using Vector = Vector3<double>;

/// Makes a query in which the primitives touch exactly at t = 0 or t = 1. Then moves one coordinate at that
/// time by x ulps.
Query end_contact(Random& random, Kind kind, double x) {
  Contact contact = integer_contact(random, kind);
  contact.time = random.integer(0, 1);
  const int speed = random.integer(0, 16);
  Query query = placed(random, meet(kind, contact, random.integer_vector(1 << speed)));
  double& c = query.x[static_cast<std::size_t>(12 * static_cast<int>(contact.time) + random.integer(0, 11))];
  c = moved_by_ulps(c, (random.one_in(2) ? 1 : -1) * static_cast<int>(x));
  return query;
}

/// Let s = alpha_sign(kind). If the weights α and β change at constant rates α' and β', the vector β r + s α
/// q follows a curve. At time t, this curve is away from its tangent by d(t) = (β' r' + s α' q') (t - time)².
/// The first primitive moves along the tangent, so F has a double root. Let 2 h be the time between the two
/// planned roots. If the first primitive is shifted by d(time + h), which is also d(time - h), it meets the
/// curve at these two times. If it is shifted the opposite way, it never meets the curve. In half of the
/// queries, both sides lie in a coordinate plane at the time of contact, and leave this plane along its
/// normal, so that even the smallest shift is exact.
Query even_roots(Random& random, Kind kind, double x) {
  const double h = random.one_in(8) ? 0 : power_of_ten(x) / 2;
  ContactSampler sampler(random);
  const bool flat = random.one_in(2);
  const Vector axis = Vector::Unit(random.integer(0, 2));
  const auto across = [&](const Vector& v) -> Vector { return flat ? v.cwiseProduct(axis) : v; };
  const auto within = [&](const Vector& v) -> Vector { return flat ? v - v.cwiseProduct(axis) : v; };

  Contact contact = sampler.contact(kind, 0);
  contact.time = std::clamp(contact.time, h, 1 - h);
  const bool q_turns = !flat || has_triangle(kind);
  const Vector q_velocity = across(sampler.vector());
  contact.q = passing(within(contact.q.start), q_turns ? q_velocity : Vector(Vector::Zero()), contact.time);
  contact.r = passing(within(contact.r.start), across(sampler.vector()), contact.time);
  const Vector stay = flat ? contact.velocity(kind) : Vector(Vector::Zero());
  move_to_origin(kind, contact, within(sampler.vector()) - stay);

  const Vector rates = sampler.vector();  // rates of the weights
  const double alpha_rate = alpha_sign(kind) * rates[0];
  const double beta_rate = rates[1];
  const Vector along = beta_rate * contact.r.at(contact.time) + alpha_rate * contact.q.at(contact.time);
  const Query query = meet(kind, contact, contact.velocity(kind) + along);
  const double side = random.one_in(4) ? -1 : 1;
  const Vector shift = side * h * h * (beta_rate * contact.r.velocity() + alpha_rate * contact.q.velocity());
  return finished(random, with_first_moved(query, shift));
}

/// F(t) = det(M0 + s M1) with s = t - time. The columns of M0 + s M1 are x0 - base, q and r. Let M1 = G C and
/// M0 = G J C, where J is nilpotent. Then F(t) is det(G) det(C) det(J + s I) = det(G) det(C) s³. The
/// primitives touch if M0 maps the vector (1, -alpha_sign(kind) α, -β) to 0. M0 does so, because all rows of
/// C except the first are orthogonal to this vector, and the rows of J C are multiples of the other rows of
/// C. Finally, q and r are changed slightly, and the point of contact moves with them.
Query triple_root(Random& random, Kind kind, double x) {
  const double off = random.one_in(8) ? 0 : power_of_ten(x);
  ContactSampler sampler(random);
  Contact contact = sampler.contact(kind, 0);
  Eigen::Matrix3d G;
  Eigen::Matrix3d C;
  for (int i = 0; i < 3; ++i) {
    G.row(i) = random.integer_vector(2);
    C.row(i) = random.integer_vector(4);
    if (i > 0) C(i, 0) = alpha_sign(kind) * contact.alpha * C(i, 1) + contact.beta * C(i, 2);
  }
  Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
  J(0, 1) = random.one_in(4) ? 0 : 1;
  J(1, 2) = random.one_in(4) ? 0 : 1;
  const Eigen::Matrix3d M0 = G * J * C;
  const Eigen::Matrix3d M1 = G * C;
  contact.q = passing(M0.col(1) + off * sampler.vector(), M1.col(1), contact.time);
  contact.r = passing(M0.col(2) + off * sampler.vector(), M1.col(2), contact.time);
  move_to_origin(kind, contact, sampler.velocity());
  Vector w = contact.base.velocity() + M1.col(0);
  if (!has_triangle(kind)) w += contact.alpha * M1.col(1);
  return finished(random, meet(kind, contact, w));
}

}  // namespace

std::vector<Family> root_families() {
  return {
      with_parameter("end-contact", "exact contact at t = 0 or t = 1, with one coordinate moved",
                     {"ulps by which the coordinate is moved = x", 0, 64, true, end_contact}),
      with_parameter("even-roots", "touching, passing and coming back; or coming near and turning back",
                     {"time between the roots = 10^x", -16, 0, false, even_roots}),
      with_parameter("triple-root", "a triple root of F, or nearly so",
                     {"how far the primitives are off = 10^x", -16, 0, false, triple_root}),
  };
}

}  // namespace nearmiss
