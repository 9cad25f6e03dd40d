// What the names of families tell.
#pragma once

#include <string_view>

#include "reports/statistics.hpp"

namespace nearmiss {

/// The families of directed searches begin so; the name of the subject that the search is for follows.
inline constexpr std::string_view miss_search_family = "search-miss-";
inline constexpr std::string_view far_search_family = "search-far-";

/// The family under which a report shows queries: "search-miss" or "search-far" for those of directed
/// searches, whatever subject these are for; any other family is shown as it is.
std::string_view shown_family(std::string_view family);

/// Where queries come from: their family, or "directed search" for those of any.
std::string_view origin(std::string_view family);

/// With the counters of families that are shown as one added up.
Statistics by_shown_family(const Statistics& statistics);

}  // namespace nearmiss
