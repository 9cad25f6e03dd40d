// How far a failing query is from what a simulation sends.
#pragma once

#include "ccd/query.hpp"
#include "reports/statistics/query_class.hpp"

namespace nearmiss {

/// A rank by which failures are shown, the lowest first: 0 for ordinary queries; 1 for degenerate ones in which no two vertices
/// coincide at t = 0 or at t = 1; 2 for other degenerate ones; 3 for extreme ones; 4 for unclassified ones; 5 for queries of any
/// class with all vertices at one point for the whole step, such as 24 zeros.
int exoticness(const Query& query, QueryClass of);

}  // namespace nearmiss
