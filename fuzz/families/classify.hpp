// The class of a single query.
#pragma once

#include <string_view>

#include "ccd/query/query.hpp"
#include "reports/statistics/query_class.hpp"

namespace nearmiss {

/// The class of a query by the rules of README.md, "Classes". It is ordinary, degenerate or extreme, never
/// `unclassified`. The rules are inequalities between polynomials, some of them evaluated at the time of the
/// first contact. Interval arithmetic decides nearly all inequalities, and exact arithmetic decides the
/// others. So the answer is exact for every query, even if the two sides of an inequality are equal. A query
/// with a coordinate that is not finite is extreme.
QueryClass classify(const Query& query);

/// Returns "extreme" for an extreme query, and "" for an ordinary query. For a degenerate query, returns the
/// first rule that holds, in a few words, such as "coplanar at an end".
std::string_view why_not_ordinary(const Query& query);

/// Accepts the queries of class `of` whose exoticness() is at most `most`. For example, if `of` is degenerate
/// and `most` is 1, it accepts degenerate queries in which no two vertices coincide.
struct NoMoreExotic {
  QueryClass of;
  int most;

  bool operator()(const Query& query) const { return classify(query) == of && exoticness(query, of) <= most; }
};

}  // namespace nearmiss
