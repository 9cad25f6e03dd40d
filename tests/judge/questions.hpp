// Questions about a query whose answers by the oracle's parts have to agree.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "ccd/query.hpp"

namespace nearmiss {

/// The first of some queries about which two parts of the oracle disagree, and which two.
struct Contradiction {
  std::size_t at;
  std::string what;  ///< "batch against exact": without blanks at its ends
};

/// Called with the number of each query before something slow is asked about it.
using Watch = std::function<void(std::size_t)>;

/// Asks about queries first, first + 1, ... of a family. The filters are asked about all of them; exact answers
/// about a share that depends on the query's number and on what the filters say; distances and times about a
/// smaller share.
std::optional<Contradiction> first_disagreement(std::span<const Query> queries, std::uint64_t first,
                                                const Watch& watch);

/// Whether the certified distances of a query fit the exact comparisons, given whether it is a collision; what
/// does not fit, or "".
std::string distance_disagreement(const Query& query, bool collision);

/// Whether the earliest time fits: at the time there is a collision, before it none, if doubles represent the motion
/// until then exactly. The contradiction, or "".
std::string time_disagreement(const Query& query, bool collision);

/// Whether static predicates say the same of the query's primitives in translation as exact arithmetic; what
/// does not fit, or "".
std::string translation_disagreement(const Query& query);

}  // namespace nearmiss
