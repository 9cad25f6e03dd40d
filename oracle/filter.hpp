// The certified filter in front of exact arithmetic: double arithmetic that never answers wrongly.
#pragma once

#include <cstdint>

#include "ccd/query.hpp"

namespace nearmiss {

/// What decided a query, or that nothing did.
enum class FilterStage : std::uint8_t {
  planes,       ///< no: a moving plane across an axis or a diagonal separates the primitives
  one_sign,     ///< no: F keeps one sign
  weights,      ///< no: wherever F may vanish, two weights have opposite signs
  sign_change,  ///< yes: F changes its sign where all weights are inside
  at_an_end,    ///< yes: the figures touch at t = 0 or t = 1, by exact predicates
  undecided,    ///< exact arithmetic must decide
};

inline constexpr std::size_t filter_stage_count = 6;

/// Whether a stage means a collision; not for `undecided`.
constexpr bool is_collision(FilterStage stage) {
  return stage == FilterStage::sign_change || stage == FilterStage::at_an_end;
}

/// Decides a query in double arithmetic with certified bounds, or leaves it undecided. Rounds to nearest.
FilterStage filter(const Query& query);

}  // namespace nearmiss
