// Families in reports: which are random samples, and which are shown together as one family.
#pragma once

#include <string>
#include <string_view>

#include "reports/statistics/family_name.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

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
