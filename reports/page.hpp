// The page of a report.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace nearmiss {

/// index.html with the report's JSON, the style, and every script inside: it needs no network.
std::string report_page(const nlohmann::ordered_json& report);

}  // namespace nearmiss
