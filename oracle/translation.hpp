// Decisions without polynomials, for primitives that only translate relative to each other.
#pragma once

#include <cstdint>
#include <optional>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// How the two primitives of a query move relative to each other.
enum class RelativeMotion : std::uint8_t {
  rest,         ///< all four points have the same velocity
  translation,  ///< each primitive has one velocity: F(t) is linear
  other,
};

/// The relative motion of a query's primitives. It is exact: it compares the differences of the given
/// coordinates without rounding. The result is `other` if a difference overflows.
RelativeMotion relative_motion(const Query& query);

/// Whether the primitives of a query at relative rest or in relative translation meet, by exact static
/// predicates. At rest, these test the primitives at t = 0. In translation, they test the segment along which
/// x0 moves and the triangle, or one edge and the parallelogram that the other edge sweeps. Nothing if these
/// predicates do not decide: the end of the relative path is not a double, or a primitive has no length or
/// area.
std::optional<bool> meets_by_translation(const Query& query);

}  // namespace nearmiss
