// Queries in which the distance just falls to the separation h > 0, or falls to it at a time that is hard to
// find. In most of these families, coordinates have few bits, so that distances and times are exact. x is the
// family's parameter.
#include <array>
#include <cmath>
#include <utility>

#include "fuzz/families/facing.hpp"
#include "fuzz/families/tables.hpp"
#include "oracle/distance.hpp"

namespace nearmiss {

namespace {

using Vector = Vector3<double>;

/// A number from 1/16 to 7 that has at most three bits.
double short_separation(Random& random) {
  const int odd_or_even = random.integer(1, 7);
  return std::ldexp(odd_or_even, -random.integer(0, 4));
}

/// Completes a query whose numbers have few bits: sets the separation, then turns and scales the query.
Query placed_apart(Random& random, const Query& query, double separation) {
  return rescaled(random, turned(random, with_separation(query, separation)));
}

/// A velocity towards the other primitive. In two of three cases, it has a sideways component.
Vector approaching(Random& random) {
  const Vector sideways = random.one_in(3) ? Vector(Vector::Zero()) : vector_in_plane(random);
  return sideways - random.integer(1, 4) * Vector::UnitZ();
}

// --- at the smallest distance ---------------------------------------------------------------------------

/// A query of another family in which the primitives stay apart. Let d be their smallest distance, rounded up
/// to a double. In half of the queries, h is (1 + 2^x) d; in the other half, h is (1 - 2^x) times the double
/// below d. If x = -54, rounding makes these values of h equal to d and to the double below d.
Query near_separation(Random& random, Kind kind, double x) {
  constexpr std::array bases{"uniform",    "uniform-end", "uniform-slow", "decimals",
                             "kilometres", "needle",      "rigid",        "near-parallel-edges"};
  const Family base = find_family(one_of(random, bases), families());
  const double off = power_of_two(x);
  const bool is_above = random.one_in(2);
  for (;;) {
    Query query = base.make(random, kind);
    repeat_vertices(query);
    const double distance = minimum_distance(query, 0).hi;
    if (distance == 0) continue;
    const double below = std::nextafter(distance, 0);
    const double h = is_above ? distance + off * distance : below - off * below;
    if (0 < h && std::isfinite(h)) return with_separation(query, h);
  }
}

/// The smallest distance is exactly h. In one of three queries, the primitives part after t = 0, or approach
/// each other until t = 1; in the others, their relative motion is sideways or zero. In half of the queries,
/// h is then changed by x ulps.
Query tied_separation(Random& random, Kind kind, double x) {
  const double h = short_separation(random);
  const bool is_at_end = random.one_in(3);
  const double time = is_at_end ? random.integer(0, 1) : sixteenths(random, 0, 16);
  const Contact contact = facing_contact(random, kind, draw_closest(random, kind), time);
  Vector w = random.one_in(3) ? Vector(Vector::Zero()) : vector_in_plane(random);
  if (is_at_end) w += (time == 0 ? 1 : -1) * random.integer(1, 4) * Vector::UnitZ();
  Query query = placed_apart(random, facing(kind, contact, w, h), h);
  const int ulps = static_cast<int>(random_sign(random) * x);
  if (random.one_in(2)) query.separation = moved_by_ulps(query.separation, ulps);
  return query;
}

// --- falling below h at a known time --------------------------------------------------------------------

/// The distance falls below h at a time inside the step; this time has x binary places.
Query reached_separation(Random& random, Kind kind, double x) {
  const double time = (std::floor(random.uniform() * power_of_two(x - 1)) + 0.5) / power_of_two(x - 1);
  const double h = short_separation(random);
  const Contact contact = facing_contact(random, kind, draw_closest(random, kind), time);
  return placed_apart(random, facing(kind, contact, approaching(random), h), h);
}

/// Primitives of size 1 to 4 come within h at a speed of about 2^x.
Query slow_approach(Random& random, Kind kind, double x) {
  const double time = sixteenths(random, 1, 15);
  const double h = short_separation(random);
  const Contact contact = facing_contact(random, kind, draw_closest(random, kind), time);
  return placed_apart(random, facing(kind, contact, power_of_two(x) * approaching(random), h), h);
}

/// Which of the sides q and r (contacts.hpp) begin or cease to be part of the closest features.
struct Sides {
  bool q, r;
};

/// The distance falls below h at a time inside the step. At a time about 2^x earlier, a closest point moves
/// from an end of a side into the interior of the side, or from the interior to an end. If the closest point
/// moves into the interior, the weight of the point is 2^x when the distance is h. If the closest point moves
/// to an end, the slope of the side relative to the plane z = 0 is about 2^x.
Query changed_features(Random& random, Kind kind, double x) {
  const double before = power_of_two(x);
  const double time = sixteenths(random, 1, 15);
  const double h = short_separation(random);
  const bool is_to_inside = random.one_in(2);
  Closest closest{};
  Sides changing{};
  while (!changing.q && !changing.r) {
    closest = draw_closest(random, kind);
    changing.q = is_closest(kind, closest, true) == is_to_inside && !random.one_in(3);
    changing.r = is_closest(kind, closest, false) == is_to_inside && !random.one_in(3);
  }
  Contact contact = facing_contact(random, kind, closest, time, is_to_inside ? 1 : before);
  if (is_to_inside && changing.q) contact.alpha = before;
  if (is_to_inside && changing.r) contact.beta = before;
  move_to_origin(kind, contact, contact.base.velocity());
  const double rate = is_to_inside ? 1 : -1;
  const auto in_plane = [](const Vector& v) { return Vector{v[0], v[1], 0}; };
  Vector w = -random.integer(1, 4) * Vector::UnitZ();
  if (changing.q) w += alpha_sign(kind) * rate * in_plane(contact.q.at(time));
  if (changing.r) w += rate * in_plane(contact.r.at(time));
  return placed_apart(random, facing(kind, contact, w, h), h);
}

// --- the start of the step ------------------------------------------------------------------------------

/// The distance is h or (1 ± 2^x) h at t = 0. Then the primitives come nearer, part, or move sideways.
Query starts_near_separation(Random& random, Kind kind, double x) {
  const double h = short_separation(random);
  const int side = random.integer(-1, 1);
  const int direction = random.integer(-1, 1);
  const Contact contact = facing_contact(random, kind, draw_closest(random, kind), 0);
  const Vector sideways = random.one_in(3) ? Vector(Vector::Zero()) : vector_in_plane(random);
  const Vector w = sideways + direction * random.integer(1, 4) * Vector::UnitZ();
  return placed_apart(random, facing(kind, contact, w, h + side * power_of_two(x) * h), h);
}

// --- other sizes of h -----------------------------------------------------------------------------------

/// The primitives have a size of 1 to 4, and h is about 4 * 10^x. In half of the queries, the primitives come
/// within h of each other. In the others, they pass each other at a distance of h, h + 1/8 or h - 1/8 or, if
/// h is less than 1/8, of h, 2 h or 0.
Query sized_separation(Random& random, Kind kind, double x) {
  constexpr double least_that_turns = 0x1p-42;  // for a smaller h, turned() may need more than 53 bits
  const double h = 4 * power_of_ten(x);
  const double time = sixteenths(random, 1, 15);
  const Contact contact = facing_contact(random, kind, draw_closest(random, kind), time);
  const bool comes_near = random.one_in(2);
  const Vector sideways = vector_in_plane(random);
  const double speed = random.one_in(2) && h > 1 ? h : 1;
  const Vector w = comes_near ? approaching(random) : sideways;
  const double off = comes_near ? 0 : random.integer(-1, 1) * std::min(h, 1.0 / 8);
  const Query query = with_separation(facing(kind, contact, speed * w, h + off), h);
  return rescaled(random, h < least_that_turns ? query : turned(random, query));
}

std::vector<Family> with_own_separations(std::vector<Family> families) {
  for (Family& family : families) family.has_separation = true;
  return families;
}

}  // namespace

std::vector<Family> approach_families() {
  Family near =
      with_parameter("near-separation", "h is just above or below the smallest distance",
                     {"h differs from the smallest distance by 2^x of it", -54, -4, true, near_separation});
  near.block_cases = 3;  // few, because the exact distance takes long to compute
  return with_own_separations({
      std::move(near),
      with_parameter("tied-separation", "the smallest distance is exactly h, or h is then moved",
                     {"ulps by which half of the separations are moved = x", 1, 64, true, tied_separation}),
      with_collisions(with_parameter("reached-separation",
                                     "the distance falls to exactly h between every pair of features",
                                     {"binary places of the time = x", 1, 32, true, reached_separation})),
      with_collisions(with_parameter(
          "slow-approach", "the distance falls to h slowly",
          {"speed of the approach / size of the primitives = 2^x", -40, -10, true, slow_approach})),
      with_collisions(with_parameter("changed-features",
                                     "the closest features change shortly before the distance falls to h",
                                     {"the change is about 2^x before", -40, -5, true, changed_features})),
      with_parameter("starts-near-separation", "the distance at t = 0 is below, at or above h",
                     {"if it is not h, it differs by 2^x of h", -40, -1, true, starts_near_separation}),
      with_parameter("sized-separation", "h is far smaller or larger than the primitives",
                     {"h / size of the primitives = 10^x", -15, 12, false, sized_separation}),
  });
}

}  // namespace nearmiss
