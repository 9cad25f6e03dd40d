// Questions about a query to which the parts of the oracle must give consistent answers.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "ccd/query.hpp"

namespace nearmiss {

/// The first query about which two parts of the oracle disagree, and the names of these parts.
struct Contradiction {
  std::size_t at;
  std::string what;  ///< "batch against exact": without blanks at its ends
};

/// Called with the number of a query before each slow question about it.
using Watch = std::function<void(std::size_t)>;

/// Asks about queries first, first + 1, ... of a family. The filters are asked about all queries. Exact
/// answers are computed for a share of the queries, chosen by number and by the filters' answers. Distances
/// and times are computed for a smaller share.
std::optional<Contradiction> first_disagreement(std::span<const Query> queries, std::uint64_t first,
                                                const Watch& watch);

/// Compares the certified distances of a query with exact comparisons. `collision` is the query's truth.
/// Returns the contradiction, or "".
std::string distance_disagreement(const Query& query, bool collision);

/// Checks the earliest time: the motion up to it must collide, and the motion up to an earlier time must not,
/// if doubles represent these motions exactly. Returns the contradiction, or "".
std::string time_disagreement(const Query& query, bool collision);

/// Compares the static predicates for the query's primitives in translation with exact arithmetic. Returns
/// the contradiction, or "".
std::string translation_disagreement(const Query& query);

}  // namespace nearmiss
