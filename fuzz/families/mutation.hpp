// Structure-aware mutations of queries, for coverage-guided fuzzers.
#pragma once

#include "ccd/query/query.hpp"
#include "fuzz/random.hpp"

namespace nearmiss {

/// Applies one to three mutations of the list in mutation.cpp. Half of these mutations move coordinates by a
/// fraction of a distance between two positions, so that a chain of calls improves a query step by step. The
/// others are drawn from the whole list, so that the fuzzer also reaches queries of other sorts. Half of the
/// calls then make the primitives touch where they nearly touch, so that chains of mutations stay near
/// collisions. One call in four also changes a separation h > 0; h = 0 never changes. If the coordinates of
/// `query` are finite, those of the result are finite, too.
Query mutated(Random& random, const Query& query);

/// Combines two queries. Groups the coordinates by vertex, by axis or by end of the step, or leaves them
/// single, and takes each group from one of the two queries, drawn at random. The kind of the result is that
/// of one of the two queries, drawn at random, and so is its separation.
Query crossed(Random& random, const Query& first, const Query& second);

}  // namespace nearmiss
