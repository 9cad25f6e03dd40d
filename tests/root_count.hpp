// The roots of F, counted by CGAL's algebraic kernel, which shares no code with the oracle.
#pragma once

#include "ccd/query/query.hpp"

namespace nearmiss::testing {

/// The roots of the coplanarity cubic F in [0, 1] at which the primitives meet.
struct RootCount {
  bool collision = false;
  bool planar = false;        ///< F is identically zero, so there are no roots to count
  bool on_boundary = false;   ///< a contact at t = 0 or 1, at a border, or of primitives without area
  int distinct = 0;           ///< number of distinct roots at which the primitives meet
  int with_multiplicity = 0;  ///< number of these roots, each counted with its multiplicity

  /// The answer of a root-parity CCD, for which an even number of roots means no collision.
  [[nodiscard]] bool odd() const { return with_multiplicity % 2 == 1; }
};
RootCount count_roots(const Query& query);

/// The number of distinct roots of F in [0, time), whether the primitives meet there or not.
int roots_before(const Query& query, double time);

}  // namespace nearmiss::testing
