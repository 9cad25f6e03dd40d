// Primitives that touch at a chosen time and place. Most families make their queries from such contacts.
#pragma once

#include <cmath>

#include "ccd/query/query.hpp"
#include "fuzz/random.hpp"

namespace nearmiss {

/// A vector that is `start` at t = 0 and `end` at t = 1.
struct Path {
  Vector3<double> start, end;

  [[nodiscard]] Vector3<double> at(double t) const { return start + t * (end - start); }
  [[nodiscard]] Vector3<double> velocity() const { return end - start; }
};

/// The path that passes `place` at `time` with this velocity.
Path passing(const Vector3<double>& place, const Vector3<double>& velocity, double time);
Path scaled(const Path& path, double factor);
inline Path still(const Vector3<double>& at) { return {at, at}; }

/// The weights of the point of contact, as in Contact, and the time of contact.
struct Aim {
  double alpha, beta;
  double time;
};

/// Two primitives and the place at which they will touch. Vertex-triangle: `base` and the sides q = x2 - x1,
/// r = x3 - x1 with x1 = base; the contact is at base + α q + β r. Edge-edge: q = x1 - x0 and r = x3 - x2
/// with x2 = base; the contact is at base + β r, and at weight α of the first edge.
struct Contact {
  Path base, q, r;
  double alpha, beta;
  double time;

  /// The second primitive's point of contact at `time`, relative to base.
  [[nodiscard]] Vector3<double> place(Kind kind) const;
  /// The velocity of the second primitive's point of contact.
  [[nodiscard]] Vector3<double> velocity(Kind kind) const;
};

/// The query in which the first primitive's point of contact moves with velocity w through the place of
/// contact, c: at time t, the point is at c + (t - time) w. The point is the vertex (vertex-triangle) or the
/// point at weight α of the first edge (edge-edge). If all numbers are small multiples of one power of two,
/// every operation is exact in double, and the primitives touch exactly at `time`.
Query meet(Kind kind, const Contact& contact, const Vector3<double>& w);

/// Draws contacts of primitives of size 1, and parts of such contacts. Half of the samplers draw multiples of
/// 1/16, so that short sums and products stay exact in double; the others draw arbitrary numbers.
class ContactSampler {
 public:
  explicit ContactSampler(Random& random) : random_(random), exact_(random.one_in(2)) {}

  /// A vector with components in [-1, 1].
  Vector3<double> vector();
  /// A vector of length about 1; in half of the calls, the vector is parallel to an axis.
  Vector3<double> direction();
  /// A power of two from 2^-bits to 1.
  double fraction(int bits) { return std::ldexp(1.0, -random_.integer(0, bits)); }
  /// A speed for primitives of size 1: 0, or between 2^-12 and 1 per step.
  double speed() { return random_.one_in(3) ? 0 : fraction(12); }
  /// A velocity of about the magnitude that fraction(12) draws.
  Vector3<double> velocity();
  /// A weight or time in [0, 1], often 0 or 1. One in eight of these numbers is outside the interval, beyond
  /// its end by a power of two that may be as small as ε.
  double weight();
  /// Draws a time, and the weights of a point that is inside the primitives, on an edge, at a vertex or
  /// slightly outside. weight() draws all three numbers.
  Aim aim(Kind kind);
  /// Primitives of size 1; aim() draws the contact. The sides change at the given speed, and base stays at 0.
  Contact contact(Kind kind, double speed);

 private:
  Random& random_;
  bool exact_;
};

/// Gives `contact.base` this velocity, and moves the contact to the origin, where doubles are densest.
void move_to_origin(Kind kind, Contact& contact, const Vector3<double>& velocity);

/// Primitives of random size on an integer grid, with multiples of 1/16 as weights and time. With an integer
/// velocity below 2^17, meet() turns the result into a query with exact contact.
Contact integer_contact(Random& random, Kind kind);

/// The sign s in the equation x0 - base = β r + s α q, which holds at a contact.
constexpr double alpha_sign(Kind kind) { return has_triangle(kind) ? 1 : -1; }

/// Moves all vertices (moved), or the vertices of the first primitive (with_first_moved), by the same vector
/// at both times. Coordinates are rounded to double.
Query moved(Query query, const Vector3<double>& by);
Query with_first_moved(Query query, const Vector3<double>& by);

/// Scales a query and its separation by a power of two, and shuffles the query. Both operations are exact.
Query rescaled(Random& random, Query query);

/// Moves one query in four by an integer vector; the move is exact if the coordinates are integers. Then
/// calls `rescaled`.
Query placed(Random& random, Query query);

/// Turns or mirrors a query with an integer matrix, which multiplies all lengths by 1, 3, 5, 7 or 9, and
/// multiplies the separation by the same number. The result is exact if the coordinates are integers below
/// 2^49, times one power of two.
Query turned(Random& random, Query query);

/// Shuffles the vertices of each primitive. If both primitives are edges, or both are vertices, also shuffles
/// the primitives.
Query shuffled(Random& random, const Query& query);

/// The double that is `ulps` doubles above c, or below it if `ulps` is negative, but never beyond the last
/// finite double.
double moved_by_ulps(double c, int ulps);

/// Moves `count` random coordinates by 1 to `most` ulps each, up or down.
Query nudged(Random& random, Query query, int count, int most);

/// The last step of the extreme families: shuffles the query, and nudges one query in four.
Query finished(Random& random, const Query& query);

/// The longest side of the bounding box of the primitives' motion.
double extent(const Query& query);

/// The power of two nearest to 10^x. Multiplying by it is exact.
double power_of_ten(double x);

inline double power_of_two(double x) { return std::ldexp(1.0, static_cast<int>(x)); }

template <class Range>
auto one_of(Random& random, const Range& values) {
  return values[static_cast<std::size_t>(random.integer(0, static_cast<int>(values.size()) - 1))];
}

inline double random_sign(Random& random) { return random.one_in(2) ? -1 : 1; }

/// A random multiple of 1/16 from first / 16 to last / 16.
inline double sixteenths(Random& random, int first, int last) { return random.integer(first, last) / 16.0; }

}  // namespace nearmiss
