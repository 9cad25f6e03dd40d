// Versions of a CCD, compared query by query: which queries the second one fixes, and which it breaks.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// A line for each pair of versions, "new against old: 12 fixed, 3 broken, 41 both fail, of 5,000 queries
/// (ordinary vt 3 broken; ...)". It names the kinds that are not compared because only one version was asked
/// about them. "" without versions.
std::string version_lines(const Statistics& statistics);

/// A list with an object for each pair of versions, class of families and kind.
nlohmann::ordered_json versions_json(const Statistics& statistics);

}  // namespace nearmiss
