// The second answer: roots counted by Sturm sequences over the integers.
#pragma once

#include "ccd/query.hpp"

namespace nearmiss {

/// The roots of the coplanarity cubic F in [0, 1] at which the primitives meet.
struct RootCount {
  bool collision = false;
  bool planar = false;  ///< F is zero identically: there are no roots to count
  bool on_boundary =
      false;  ///< a contact at t = 0 or t = 1, at a border of a primitive, or of primitives without an area
  int distinct = 0;           ///< roots at which the primitives meet
  int with_multiplicity = 0;  ///< the same, a double root counted twice

  /// The answer of a root-parity CCD, which takes an even number of roots for no collision.
  [[nodiscard]] bool odd() const { return with_multiplicity % 2 == 1; }
};

/// Isolates the roots of F in [0, 1] by Sturm's theorem and determines the signs of the barycentric weights there by
/// Tarski's queries. Complete, for every finite query; shares nothing with the first answer but the query.
RootCount count_roots(const Query& query);

}  // namespace nearmiss
