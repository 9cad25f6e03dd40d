// Directed search: queries that one subject answers wrongly, or nearly so, by optimisation without derivatives.
#pragma once

#include "ccd/query.hpp"
#include "ccd/subject.hpp"
#include "fuzz/random.hpp"

namespace nearmiss {

/// How many queries a search shows to the subject, at most.
inline constexpr int search_evaluations = 2000;

/// A collision that the subject misses, or else the one that it nearly missed of all it was shown.
///
/// The search moves on the manifold of contacts: figures that are made to meet, half of the time on a grid on
/// which that is exact, else with all bits of a double, where the oracle tells whether they still do. What is
/// maximised is the subject's needed tolerance; where it does not
/// tell one, a random mixture of what makes a contact hard: a grazing motion, a small angle between the
/// figures, a small weight, unequal edges, a time near 0 or 1. Starts are drawn; the search goes on from the
/// best so far. A pure function of its arguments.
Query search_miss(const Subject& subject, Random& random, Kind kind);

/// A query without a collision that the subject reports, as far from contact as was found, as a fraction of the
/// bound that it claims (or else of wang's); one that refutes the bound ends the search. Any query where no
/// false positive was found. A pure function of its arguments.
Query search_far_positive(const Subject& subject, Random& random, Kind kind);

}  // namespace nearmiss
