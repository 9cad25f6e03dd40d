// The second exact method: roots counted by Sturm sequences over the integers.
#pragma once

#include <memory>

#include "ccd/query/query.hpp"

namespace nearmiss {

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

/// Isolates the roots of F in [0, 1] by Sturm's theorem, and determines the signs of the barycentric weights
/// there by interval arithmetic, or by common factors if they are 0. It is complete for every finite query,
/// and shares no code with the first method.
RootCount count_roots(const Query& query);

/// The contacts of two primitives, by the method of count_roots.
class SturmContact {
 public:
  explicit SturmContact(const Query& query);
  ~SturmContact();
  SturmContact(const SturmContact&) = delete;
  SturmContact& operator=(const SturmContact&) = delete;

  /// Whether the primitives share a point at some t in [0, 1] with t < time.
  bool is_before(double time);

 private:
  struct Candidates;
  std::unique_ptr<Candidates> candidates_;
};

}  // namespace nearmiss
