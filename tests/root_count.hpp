// Counts roots of the coplanarity cubic F with CGAL's algebraic kernel, which shares no code with the oracle.
#pragma once

#include "ccd/query/query.hpp"

namespace nearmiss::testing {

/// The contacts of two primitives in [0, 1], counted as roots of F. Roots without contact do not count.
struct RootCount {
  bool collision = false;
  bool planar = false;        ///< F is identically zero, so there are no roots to count
  bool on_boundary = false;   ///< a contact is at t = 0 or 1 or at a border, or N = 0 or F ≡ 0 there
  int distinct = 0;           ///< number of distinct roots at which the primitives meet
  int with_multiplicity = 0;  ///< number of these roots, each counted with its multiplicity

  /// The answer of a root-parity CCD, which reports a collision iff `with_multiplicity` is odd.
  [[nodiscard]] bool odd() const { return with_multiplicity % 2 == 1; }
};
RootCount count_roots(const Query& query);

/// The number of distinct roots of F in [0, time), with or without contact.
int roots_before(const Query& query, double time);

}  // namespace nearmiss::testing
