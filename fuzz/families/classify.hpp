// The class of a single query.
#pragma once

#include <string_view>

#include "ccd/query/query.hpp"
#include "reports/statistics/query_class.hpp"

namespace nearmiss {

/// The class of a query by the rules of README.md, "Classes": ordinary, degenerate or extreme, never
/// `unclassified`. The rules are polynomial inequalities, some of them at the time of the first contact.
/// Intervals decide nearly all of them, and exact arithmetic the others, so the answer is exact for every
/// query, even if a value equals its limit. A query with a coordinate that is not finite is extreme.
QueryClass classify(const Query& query);

/// For an extreme query, "extreme"; for a degenerate query, the first rule that holds, in a few words, such
/// as "coplanar at an end"; for an ordinary query, "".
std::string_view why_not_ordinary(const Query& query);

/// Accepts the queries of class `of` whose exoticness is at most `most`: for example, degenerate queries
/// whose vertices do not coincide.
struct NoMoreExotic {
  QueryClass of;
  int most;  ///< exoticness

  bool operator()(const Query& query) const { return classify(query) == of && exoticness(query, of) <= most; }
};

}  // namespace nearmiss
