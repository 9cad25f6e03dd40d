// The page of a report.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace nearmiss {

/// index.html, which contains the report's JSON, the style, and every script: it needs no network.
std::string report_page(const nlohmann::ordered_json& report);

}  // namespace nearmiss
