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

/// The path that is at `place` at the time `time`, and has this velocity.
Path passing(const Vector3<double>& place, const Vector3<double>& velocity, double time);
Path scaled(const Path& path, double factor);
inline Path still(const Vector3<double>& at) { return {at, at}; }

/// The weights α and β of the point of contact, as Contact defines them, and the time of contact.
struct Aim {
  double alpha, beta;
  double time;
};

/// Two primitives and the place at which they will touch. Vertex-triangle: x1 = base, and the triangle has
/// the sides q = x2 - x1 and r = x3 - x1; the contact is at base + α q + β r. Edge-edge: x2 = base, and the
/// edges are q = x1 - x0 and r = x3 - x2; the contact is at base + β r, which is the point x0 + α q of the
/// first edge.
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
/// contact, c: at time t, the point is at c + (t - time) w. This point is the vertex (vertex-triangle) or the
/// point x0 + α q of the first edge (edge-edge). If all numbers are small multiples of one power of two,
/// every operation is exact in double, and the primitives touch exactly at `time`.
Query meet(Kind kind, const Contact& contact, const Vector3<double>& w);

/// Draws contacts of primitives of size 1, and single vectors and numbers for such contacts. Each sampler
/// decides once, at random, whether it draws multiples of 1/16, so that short sums and products stay exact in
/// double, or arbitrary numbers.
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
  /// A velocity whose magnitude is about a number that fraction(12) draws.
  Vector3<double> velocity();
  /// A weight or time in [0, 1], often 0 or 1. One in eight of these numbers is outside this interval: it is
  /// beyond 0 or 1 by a power of two, which may be as small as ε.
  double weight();
  /// Draws a time of contact, and the weights of a point that is inside the primitives, on an edge, at a
  /// vertex or slightly outside. All three numbers come from weight().
  Aim aim(Kind kind);
  /// Draws primitives of size 1; aim() draws the weights and the time of their contact. The sides change at
  /// the given speed, and `base` stays at 0.
  Contact contact(Kind kind, double speed);

 private:
  Random& random_;
  bool exact_;
};

/// Gives `contact.base` this velocity, and moves the point of contact to the origin, where doubles are
/// densest.
void move_to_origin(Kind kind, Contact& contact, const Vector3<double>& velocity);

/// Primitives of random size, whose vertices have integer coordinates. The weights and the time of contact
/// are multiples of 1/16. From the result and an integer velocity below 2^17, meet() makes a query in which
/// the primitives touch exactly.
Contact integer_contact(Random& random, Kind kind);

/// The sign s in the equation x0 - base = β r + s α q, which holds at the time of contact.
constexpr double alpha_sign(Kind kind) { return has_triangle(kind) ? 1 : -1; }

/// moved() moves all vertices by a vector, with_first_moved() only the vertices of the first primitive. The
/// vector is the same at t = 0 and t = 1. Coordinates are rounded to double.
Query moved(Query query, const Vector3<double>& by);
Query with_first_moved(Query query, const Vector3<double>& by);

/// Multiplies a query and its separation by a power of two, then calls shuffled(). Both operations are exact.
Query rescaled(Random& random, Query query);

/// Moves one query in four by an integer vector, which is exact if the coordinates are integers of few bits.
/// Then calls rescaled().
Query placed(Random& random, Query query);

/// Turns or mirrors a query by an integer matrix. The matrix also multiplies all lengths by 1, 3, 5, 7 or 9,
/// and the function multiplies the separation by the same number. The result is exact if the coordinates are
/// integers below 2^49, times a power of two that all of them share.
Query turned(Random& random, Query query);

/// Shuffles the vertices of each primitive. If both primitives are edges, or both are vertices, also shuffles
/// the primitives.
Query shuffled(Random& random, const Query& query);

/// The double that is `ulps` doubles above c, or below it if `ulps` is negative, but never beyond the last
/// finite double.
double moved_by_ulps(double c, int ulps);

/// Moves `count` random coordinates by 1 to `most` ulps each, up or down.
Query nudged(Random& random, Query query, int count, int most);

/// The last step of the extreme families: calls shuffled() and, for one query in four, nudged().
Query finished(Random& random, const Query& query);

/// The longest side of the bounding box of the primitives' motion.
double extent(const Query& query);

/// The power of two nearest to 10^x. Multiplying a double by a power of two is exact.
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
