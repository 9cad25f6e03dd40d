// Figures that are brought into contact at a chosen time and place: what the hunting families are made of.
#pragma once

#include <array>

#include "ccd/query.hpp"
#include "fuzz/random.hpp"

namespace nearmiss {

/// A vector that is `start` at t = 0 and `end` at t = 1.
struct Path {
  Vector3<double> start, end;

  [[nodiscard]] Vector3<double> at(double t) const { return start + t * (end - start); }
  [[nodiscard]] Vector3<double> velocity() const { return end - start; }
};

/// Two figures and the place where they are to touch. Vertex-triangle: `base` and the sides q = x2 - x1, r =
/// x3 - x1 with x1 = base; the contact is at base + α q + β r. Edge-edge: q = x1 - x0 and r = x3 - x2 with x2
/// = base; the contact is at base + β r, and at weight α of the first edge.
struct Contact {
  Path base, q, r;
  double alpha, beta;
  double time;

  /// The velocity of the second figure's point of contact.
  [[nodiscard]] Vector3<double> velocity(Kind kind) const;
};

/// The query in which the first figure moves through the contact with velocity w: the vertex is at c + (t -
/// time) w, and so is the point at weight α of the first edge. Where all parts are multiples of a power of
/// two and few bits long, every operation here is exact in double, and the query touches exactly at `time`.
Query meet(Kind kind, const Contact& contact, const Vector3<double>& w);

/// The same query with the vertices of each primitive in a random order.
Query shuffled(Random& random, const Query& query);

/// Moves `count` random coordinates by 1 to `most` ulps each, up or down.
Query nudged(Random& random, Query query, int count, int most);

}  // namespace nearmiss
