// Directed search: queries that one subject answers wrongly, or nearly so, by optimisation without
// derivatives.
#pragma once

#include "ccd/subject.hpp"
#include "fuzz/families/families.hpp"

namespace nearmiss {

/// How many queries a search shows to the subject for one that it gives, at most.
inline constexpr int search_evaluations = 2000;

/// "search-miss-NAME": each query is a collision that the subject misses, or else the one that it nearly
/// missed of all it was shown.
///
/// The search moves on the manifold of contacts: primitives that are made to meet, half of the time on a grid on
/// which that is exact, else with all bits of a double, where the oracle tells whether they still do. What is
/// maximised is the subject's needed tolerance; where it does not tell one, a random mixture of what makes a
/// contact hard: a grazing motion, a small angle between the primitives, a small weight, unequal edges, a time
/// near 0 or 1. Starts are drawn; the search goes on from the best so far. The subject must outlive the
/// family.
Family miss_search(const Subject& subject);

/// "search-far-NAME": each query is a false positive, as far from contact as was found, as a fraction of the
/// bound that the subject claims (or else of wang's); one that refutes the bound ends a search. Where none
/// was found, a query that is none. The subject must outlive the family.
Family far_search(const Subject& subject);

}  // namespace nearmiss
