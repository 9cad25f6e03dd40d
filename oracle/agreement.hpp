// The three answers side by side.
#pragma once

#include <cstdint>
#include <string>

#include "ccd/query.hpp"
#include "oracle/parity.hpp"
#include "oracle/sturm.hpp"

namespace nearmiss {

/// What exact arithmetic says in three ways that share no code.
struct Answers {
  bool exact = false;
  RootCount sturm;
  RootParity parity;

  /// exact and sturm must be the same; parity must be that of sturm's count, but where the origin is on the
  /// boundary, which both must know.
  [[nodiscard]] bool agree() const { return disagreement().empty(); }
  /// What does not fit to what sturm says, of "exact", "boundary" and "parity"; "" where they agree.
  [[nodiscard]] std::string disagreement() const;

  /// A collision that a root-parity CCD takes for none: an even number of roots.
  [[nodiscard]] bool missed_by_parity() const { return exact && !parity.collision(); }
};

/// Asks all three.
Answers ask_all(const Query& query);

/// The same where the first answer is known already.
Answers ask_others(const Query& query, bool exact);

/// Whether a query belongs to a fixed fraction, one in so many by a hash of its coordinates.
bool is_sampled(const Query& query, std::uint64_t one_in);

}  // namespace nearmiss
