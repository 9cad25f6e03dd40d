// Questions about a query to which the parts of the oracle must give consistent answers.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "ccd/query/query.hpp"
#include "oracle/arithmetic/enclosure.hpp"

namespace nearmiss {

/// The first query about which two parts of the oracle disagree, and the names of these parts.
struct Contradiction {
  std::size_t at;
  std::string what;  ///< such as "batch against exact"; has no blanks at its ends
};

/// Called with the number of a query before each slow question about it.
using Watch = std::function<void(std::size_t)>;

/// Asks about queries first, first + 1, ... of a family that asks for contact. The filters are asked about
/// all queries. Exact answers are computed for a share of the queries, chosen by number and by the filters'
/// answers. Distances and times are computed for a smaller share.
std::optional<Contradiction> first_disagreement(std::span<const Query> queries, std::uint64_t first,
                                                const Watch& watch);

/// Asks about queries of a family with separations. All queries are decided by all methods. Times and
/// features are computed for a share of the queries, and for all queries whose smallest distance is the
/// separation.
std::optional<Contradiction> first_approach_disagreement(std::span<const Query> queries, std::uint64_t first,
                                                         const Watch& watch);

// Each of these functions returns the name of a contradiction, or "".

/// Compares the certified distances of a query with exact comparisons. `collision` is the query's truth.
std::string distance_disagreement(const Query& query, bool collision);

/// Compares the answers about a query for separations at and next to its smallest distance.
std::string closest_approach_disagreement(const Query& query, const Enclosure& smallest);

/// Compares the earliest time with exact decisions about the motion up to other times. `happens`: whether the
/// distance is at most the query's separation at some time.
std::string time_disagreement(const Query& query, bool happens);

/// Compares the static predicates for the query's primitives in translation with exact arithmetic.
std::string translation_disagreement(const Query& query);

/// The query with other positions at t = 1, such that no primitive turns or is deformed. They may be
/// infinite.
Query in_translation(const Query& query);

/// Whether magnitudes are so far apart that exact arithmetic takes long.
bool is_wide(const Query& query);

/// The next double above x; and the next double below a nonnegative x, or 0 for 0.
inline double above(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }
inline double below(double x) { return std::nextafter(x, 0.0); }

}  // namespace nearmiss
