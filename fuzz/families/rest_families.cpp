// Primitives at rest, for functions that measure their distance. x is the family's parameter.
#include <cmath>

#include "fuzz/families/contacts.hpp"
#include "fuzz/families/tables.hpp"

namespace nearmiss {

namespace {

using Vector = Vector3<double>;

/// Two primitives of about size 1, and a point on each primitive, often on the primitive's border. The vector
/// `gap` goes from the second primitive's point to the first primitive's point. In half of the queries, `gap`
/// is parallel to q × r.
struct Draft {
  Contact contact;
  Vector gap;

  Draft(Random& random, Kind kind) {
    ContactSampler sampler(random);
    contact = sampler.contact(kind, 0);
    contact.q = still(random.vector(1));
    contact.r = still(random.vector(1));
    const double length = power_of_ten(random.uniform(-5, 0.3));
    const Vector any = random.vector(1);
    gap = length * any;
    if (random.one_in(2)) gap = length * contact.q.start.cross(contact.r.start);
  }

  /// The query of the drawn primitives, moved to a random place.
  [[nodiscard]] Query query(Random& random, Kind kind) const {
    Contact at = contact;
    at.base = still(random.vector(1));
    Query query = with_first_moved(meet(kind, at, Vector::Zero()), gap);
    for (int i = 0; i < 4; ++i) query.set_end(i, query.start(i));
    return shuffled(random, query);
  }
};

Query rest(Random& random, Kind kind) {
  const Draft draft(random, kind);
  return draft.query(random, kind);
}

/// Half of the pairs touch exactly, at the origin.
Query rest_touching(Random& random, Kind kind) {
  ContactSampler sampler(random);
  Contact contact = sampler.contact(kind, 0);
  move_to_origin(kind, contact, Vector::Zero());
  return shuffled(random, meet(kind, contact, Vector::Zero()));
}

Query rest_units(Random& random, Kind kind, double x) {
  Query query = rest(random, kind);
  for (double& c : query.x) c = std::ldexp(c, static_cast<int>(x));
  return query;
}

Query rest_distant(Random& random, Kind kind, double x) {
  const Query query = rest(random, kind);
  return moved(query, power_of_two(x) * random.vector(1));
}

/// The tangent of the angle between the sides q and r is 2^x.
Query rest_angle(Random& random, Kind kind, double x) {
  Draft draft(random, kind);
  const Vector q = draft.contact.q.start;
  const Vector across = random.vector(1);
  const double along = random_sign(random) * random.uniform(0.25, 1.25);
  const double squared = q.squaredNorm();
  if (squared > 0) {
    const Vector perpendicular = across - across.dot(q) / squared * q;
    const double length = perpendicular.norm();
    const Vector turned = length > 0 ? Vector(std::sqrt(squared) / length * perpendicular) : perpendicular;
    draft.contact.r = still(along * (q + power_of_two(x) * turned));
  }
  return draft.query(random, kind);
}

/// One of the sides q and r is multiplied by 2^x.
Query rest_ratio(Random& random, Kind kind, double x) {
  Draft draft(random, kind);
  Path& shorter = random.one_in(2) ? draft.contact.q : draft.contact.r;
  shorter = scaled(shorter, power_of_two(x));
  return draft.query(random, kind);
}

}  // namespace

std::vector<Family> rest_families() {
  return {{.name = "rest", .about = "primitives at rest, apart by 1e-5 to 2 of their size", .make = rest},
          {.name = "rest-touching",
           .about = "primitives at rest that touch, or nearly so",
           .make = rest_touching},
          with_parameter("rest-units", "primitives at rest in other units",
                         {"length of the edges = about 2^x", -30, 30, true, rest_units, "edge"}),
          with_parameter("rest-distant", "primitives at rest far from the origin",
                         {"distance from the origin / length of the edges = about 2^x", 0, 26, true,
                          rest_distant, "distance"}),
          with_parameter("rest-angle", "nearly parallel edges, or slivers, at rest",
                         {"tangent of the angle between two edges = 2^x", -50, 0, true, rest_angle, "angle"}),
          with_parameter(
              "rest-ratio", "edges of different lengths, at rest",
              {"length of one edge / that of another = about 2^x", -26, 0, true, rest_ratio, "ratio"})};
}

}  // namespace nearmiss
