// Classes of queries: how near they are to those of a simulation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "ccd/query.hpp"

namespace nearmiss {

/// How near a query, or most queries of a family, are to those of a simulation. fuzz/families/README.md has the criterion.
enum class QueryClass : std::uint8_t {
  ordinary,    ///< what a simulation meets in every step
  degenerate,  ///< what it meets now and then
  extreme,     ///< what no simulation should send
  unclassified  ///< nobody has said; of families: cases, directed searches, and those that this program does not know
};

/// Names in files and reports, in order.
inline constexpr std::array<std::string_view, 4> class_names{"ordinary", "degenerate", "extreme",
                                                             "unclassified"};

inline int exoticness(const Query& query, QueryClass of) {
  return 2 * static_cast<int>(of) + (query.x == decltype(query.x){});
}

constexpr std::string_view name(QueryClass of) { return class_names[static_cast<std::size_t>(of)]; }

}  // namespace nearmiss
