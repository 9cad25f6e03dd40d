// Classes of queries: how near queries are to those of a simulation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// Says how similar a query is to the queries that simulations make. The class of a family is the class of
/// most of its queries. fuzz/families/README.md says how queries are classified.
enum class QueryClass : std::uint8_t {
  ordinary,     ///< queries that a simulation makes in every step
  degenerate,   ///< queries that a simulation makes now and then
  extreme,      ///< queries that no simulation should make
  unclassified  ///< unknown, as for cases, directed searches, and families that this program does not know
};

/// The names of the classes, as files and reports write them, in the order of the enumeration.
inline constexpr std::array<std::string_view, 4> class_names{"ordinary", "degenerate", "extreme",
                                                             "unclassified"};

constexpr std::string_view name(QueryClass of) { return class_names[static_cast<std::size_t>(of)]; }

/// The rank of a query by which reports sort failures, lowest first. Ordinary queries have rank 0.
/// Degenerate queries have rank 1 if no two vertices coincide at t = 0 or at t = 1, 3 if all vertices stay
/// at one point (such as 24 zeros), and 2 otherwise. Extreme queries have rank 4 if no two vertices coincide
/// at t = 0 or at t = 1, and 5 otherwise. Unclassified queries have rank 6.
int exoticness(const Query& query, QueryClass of);

}  // namespace nearmiss
