// Structure-aware mutations of queries, for coverage-guided fuzzers.
#pragma once

#include "ccd/query/query.hpp"
#include "fuzz/random.hpp"

namespace nearmiss {

/// Applies one to three mutations from the list in mutation.cpp. In half of the cases, the mutation moves
/// coordinates by a fraction of the distance between two positions, so that a chain of calls can improve a
/// query step by step. In the other half, the mutation is drawn from the whole list, so that the fuzzer also
/// reaches queries of other sorts. Half of the calls then move a vertex so that the primitives touch at the
/// place where they nearly touch. This keeps chains of mutations near collisions. One call in four also
/// changes a separation h > 0; h = 0 never changes. If the coordinates of `query` are finite, the coordinates
/// of the result are finite, too.
Query mutated(Random& random, const Query& query);

/// Combines two queries. Divides the coordinates into groups: by vertex, by axis, by end of the step, or each
/// coordinate by itself. Takes each group from one of the two queries, chosen at random. Takes the kind from
/// one of the two queries, and the separation from one of them; these two choices are random, too.
Query crossed(Random& random, const Query& first, const Query& second);

}  // namespace nearmiss
