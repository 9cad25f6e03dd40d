// Primitives that are brought into contact at a chosen time and place: what the hunting families are made of.
#pragma once

#include <cmath>

#include "ccd/query.hpp"
#include "fuzz/random.hpp"

namespace nearmiss {

/// A vector that is `start` at t = 0 and `end` at t = 1.
struct Path {
  Vector3<double> start, end;

  [[nodiscard]] Vector3<double> at(double t) const { return start + t * (end - start); }
  [[nodiscard]] Vector3<double> velocity() const { return end - start; }
};

/// The path that is at `place` at a time.
Path passing(const Vector3<double>& place, const Vector3<double>& velocity, double time);
Path scaled(const Path& path, double factor);

/// Where two primitives are to touch, as Contact says, and when.
struct Aim {
  double alpha, beta;
  double time;
};

/// Two primitives and the place where they are to touch. Vertex-triangle: `base` and the sides q = x2 - x1, r =
/// x3 - x1 with x1 = base; the contact is at base + α q + β r. Edge-edge: q = x1 - x0 and r = x3 - x2 with x2
/// = base; the contact is at base + β r, and at weight α of the first edge.
struct Contact {
  Path base, q, r;
  double alpha, beta;
  double time;

  /// The second primitive's point of contact, seen from base.
  [[nodiscard]] Vector3<double> place(Kind kind) const;
  /// The velocity of the second primitive's point of contact.
  [[nodiscard]] Vector3<double> velocity(Kind kind) const;
};

/// The query in which the first primitive moves through the contact with velocity w: the vertex is at c + (t -
/// time) w, and so is the point at weight α of the first edge. Where all parts are multiples of a power of
/// two and few bits long, every operation here is exact in double, and the query touches exactly at `time`.
Query meet(Kind kind, const Contact& contact, const Vector3<double>& w);

/// ContactSampler of one size from which primitives are made: for one half of the objects sixteenths, so that sums and
/// products of a few stay exact in double, for the other half any sampler.
class ContactSampler {
 public:
  explicit ContactSampler(Random& random) : random_(random), exact_(random.one_in(2)) {}

  /// Components in [-1, 1].
  Vector3<double> vector();
  /// Along an axis, half of the time; of a length of about 1.
  Vector3<double> direction();
  /// 1, or smaller by a power of two of up to so many bits.
  double fraction(int bits) { return std::ldexp(1.0, -random_.integer(0, bits)); }
  /// How far things of size 1 move in a step: not at all, or up to their size.
  double speed() { return random_.one_in(3) ? 0 : fraction(12); }
  /// Up to 1 a step, or far less.
  Vector3<double> velocity();
  /// In [0, 1], often 0 or 1; one in eight is outside, by a power of two down to ε.
  double weight();
  /// Inside, on edges, in vertices, a little outside; the time likewise.
  Aim aim(Kind kind);
  /// Primitives of size 1 with an aim, whose sides change at a speed; base is left at 0.
  Contact contact(Kind kind, double speed);

 private:
  Random& random_;
  bool exact_;
};

/// Gives base this velocity and the place where the point of contact is the origin at its time: around it,
/// coordinates of any size are as exact as they can be.
void move_to_origin(Kind kind, Contact& contact, const Vector3<double>& velocity);

/// Primitives on an integer grid, with weights and time that are multiples of 1/16, of any size: the query that
/// meet() makes of them with an integer velocity below 2^17 touches exactly.
Contact integer_contact(Random& random, Kind kind);

/// Moves integers by an integer vector, now and then, scales by a power of two, and shuffles: all exactly.
Query placed(Random& random, Query query);

/// The same query with the vertices of each primitive in a random order.
Query shuffled(Random& random, const Query& query);

/// The double that is so many doubles above, or below where `ulps` is negative; the last finite one at most.
double moved_by_ulps(double c, int ulps);

/// Moves `count` random coordinates by 1 to `most` ulps each, up or down.
Query nudged(Random& random, Query query, int count, int most);

/// A query as it leaves an extreme family: shuffled, and one in four nudged.
Query finished(Random& random, const Query& query);

/// The largest side of the box that the primitives sweep.
double extent(const Query& query);

/// The power of two nearest to 10^x: to multiply by it is exact.
double power_of_ten(double x);

}  // namespace nearmiss
