// Primitives that do not turn or bend as they move against each other: decided without a polynomial.
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

/// Exactly: velocities are compared as the differences of the given coordinates, not as rounded. `other`
/// where a difference overflows.
RelativeMotion relative_motion(const Query& query);

/// Whether the primitives of a query at relative rest or translation meet, by exact static predicates: of rest
/// the primitives at t = 0 themselves; of translation the segment along which x0 moves and the triangle, or one
/// edge and the parallelogram that the other one sweeps. Nothing where that cannot be told so: where the
/// relative path's end is no double, or primitives have no length or area.
std::optional<bool> meets_by_translation(const Query& query);

}  // namespace nearmiss
