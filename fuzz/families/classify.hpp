// The class of a single query.
#pragma once

#include "ccd/query/query.hpp"
#include "reports/statistics/query_class.hpp"

namespace nearmiss {

/// The class of a query by the rules of README.md, "Classes": ordinary, degenerate or extreme, never
/// `unclassified`. The rules are polynomial inequalities, some of them at the time of the first contact.
/// Intervals decide nearly all of them, and exact arithmetic the others, so the answer is exact for every
/// query, also in a tie. A query with a coordinate that is not finite is extreme.
QueryClass classify(const Query& query);

/// The queries of a class that are at most as exotic as one of them: some degenerate queries have coincident
/// vertices, others have not.
struct NoMoreExotic {
  QueryClass of;
  int most;  ///< exoticness

  bool operator()(const Query& query) const { return classify(query) == of && exoticness(query, of) <= most; }
};

}  // namespace nearmiss
