// Directed search: optimisation without derivatives, for queries that one subject answers wrongly or nearly so.
#pragma once

#include "ccd/subject.hpp"
#include "fuzz/families/families.hpp"

namespace nearmiss {

/// The number of queries that a search asks the subject about for one that it returns, at most.
inline constexpr int search_evaluations = 2000;

/// "search-miss-NAME": each query is a collision that the subject misses, or else the one that it came nearest to
/// missing.
///
/// The search moves on the manifold of contacts: the primitives are made to meet. Half of the searches use a grid on
/// which that is exact; the others use all bits of a double, and the oracle decides whether the primitives still
/// meet. The search maximises the subject's needed tolerance. If the subject gives none, it maximises a random
/// mixture of what makes a contact hard: a grazing motion, a small angle between the primitives, a small weight,
/// unequal edges, a time near 0 or 1. Starts are drawn; the search continues from the best so far. The subject must
/// outlive the family.
Family miss_search(const Subject& subject);

/// "search-far-NAME": each query is the farthest false positive that a search found, relative to the bound that the
/// subject claims, or else to wang's. One that refutes the bound ends the search. A search without any false positive
/// returns another query. The subject must outlive the family.
Family far_search(const Subject& subject);

}  // namespace nearmiss
