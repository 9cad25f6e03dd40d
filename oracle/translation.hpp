// Decisions without a polynomial, for primitives that only translate against each other.
#pragma once

#include <cstdint>
#include <optional>

#include "ccd/query.hpp"

namespace nearmiss {

/// How the two primitives of a query move relative to each other.
enum class RelativeMotion : std::uint8_t {
  rest,         ///< all four points have the same velocity
  translation,  ///< each primitive has one velocity: F(t) is linear
  other,
};

/// Exactly: velocities are compared as the differences of the given coordinates, not as rounded. `other` if a
/// difference overflows.
RelativeMotion relative_motion(const Query& query);

/// Whether the primitives of a query at relative rest or translation meet, by exact static predicates: of rest
/// the primitives at t = 0 themselves; of translation the segment along which x0 moves and the triangle, or one
/// edge and the parallelogram that the other one sweeps. Nothing if these predicates do not
/// decide it: the end of the relative path is not a double, or a primitive has no length or area.
std::optional<bool> meets_by_translation(const Query& query);

}  // namespace nearmiss
