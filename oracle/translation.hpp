// Decisions without polynomials, for primitives that only translate relative to each other.
#pragma once

#include <cstdint>
#include <optional>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// How the two primitives of a query move relative to each other.
enum class RelativeMotion : std::uint8_t {
  rest,         ///< all four vertices have the same velocity
  translation,  ///< within each primitive, all vertices have the same velocity; so F(t) is linear
  other,
};

/// Finds the relative motion by exact comparisons of differences of coordinates. Returns `other` if one of
/// these differences overflows.
RelativeMotion relative_motion(const Query& query);

/// Whether primitives at relative rest or in relative translation meet. If they are at rest, exact static
/// predicates test whether they meet at t = 0. In translation, the predicates look at the motion relative to
/// one primitive, which is then at rest. For vertex-triangle, they test whether the segment along which x0
/// moves meets the triangle. For edge-edge, they test whether one edge meets the parallelogram that the other
/// edge sweeps. The predicates cannot decide if the end of this motion is not a double, or if a primitive has
/// no length or area. Then the result is nothing.
std::optional<bool> meets_by_translation(const Query& query);

}  // namespace nearmiss
