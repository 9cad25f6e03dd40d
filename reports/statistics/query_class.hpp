// Classes of queries: how near they are to those of a simulation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// How near a query, or most queries of a family, are to those of a simulation. fuzz/families/README.md has
/// the criterion.
enum class QueryClass : std::uint8_t {
  ordinary,     ///< what a simulation meets in every step
  degenerate,   ///< what it meets now and then
  extreme,      ///< what no simulation should send
  unclassified  ///< unknown, as for cases, directed searches, and families that this program does not know
};

/// Names in files and reports, in order.
inline constexpr std::array<std::string_view, 4> class_names{"ordinary", "degenerate", "extreme",
                                                             "unclassified"};

constexpr std::string_view name(QueryClass of) { return class_names[static_cast<std::size_t>(of)]; }

/// A rank by which failures are shown, the lowest first: 0 for ordinary queries; 1 for degenerate ones in
/// which no two vertices coincide at t = 0 or at t = 1; 2 for other degenerate ones; 3 for those with all
/// vertices at one point for the whole step, such as 24 zeros; 4 for extreme queries in which no two vertices
/// coincide at an end; 5 for other extreme ones; 6 for unclassified ones.
int exoticness(const Query& query, QueryClass of);

}  // namespace nearmiss
