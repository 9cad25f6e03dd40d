// Structure-aware mutations of queries, for coverage-guided fuzzers.
#pragma once

#include "ccd/query/query.hpp"
#include "fuzz/random.hpp"

namespace nearmiss {

/// Applies one to three mutations of the list in mutation.cpp. Half of these mutations move something by a
/// fraction, to improve a query step by step; the others are drawn from the whole list, to explore. Half of
/// the calls then restore contact where the primitives nearly touch, so that chains of mutations stay near
/// collisions. One call in four also changes a separation h > 0; h = 0 never changes. The result is finite if
/// `query` is.
Query mutated(Random& random, const Query& query);

/// Takes some vertices, axes, times or single coordinates from one query, and the rest from the other. The
/// separation is that of one of the two queries.
Query crossed(Random& random, const Query& first, const Query& second);

}  // namespace nearmiss
