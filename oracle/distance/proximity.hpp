// Decides whether two primitives come within a given distance, in exact arithmetic.
#pragma once

#include "ccd/query/query.hpp"

namespace nearmiss {

/// Whether the smallest distance over [0, 1] is at most `bound`, a finite number >= 0. Exact for every finite
/// query.
bool comes_within(const Query& query, double bound);

}  // namespace nearmiss
