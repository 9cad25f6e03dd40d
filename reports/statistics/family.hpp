// Names of families, and what they mean.
#pragma once

#include <string>
#include <string_view>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// Prefixes of the families of directed searches; the name of the subject that the search is for follows, and ~SEPARATION if
/// the queries have one.
inline constexpr std::string_view miss_search_family = "search-miss-";
inline constexpr std::string_view far_search_family = "search-far-";
inline constexpr std::string_view late_search_family = "search-late-";
inline constexpr std::string_view early_search_family = "search-early-";

/// Whether a family's queries are drawn at random. Cases and scenes are not.
bool is_random(std::string_view family);

/// The family under which a report shows queries. Directed searches for all subjects are shown as
/// "search-miss", "search-far~drawn" and so on, other families under their own names.
std::string shown_family(std::string_view family);

/// The origin of queries: "directed search", or their family.
std::string_view origin(std::string_view family);

/// Statistics in which families that are shown as one are added up.
Statistics by_shown_family(const Statistics& statistics);

}  // namespace nearmiss
