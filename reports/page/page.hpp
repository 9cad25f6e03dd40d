// The pages of a report and of a history.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace nearmiss {

/// index.html, which contains the report's JSON, the style, and every script: it needs no network.
std::string report_page(const nlohmann::ordered_json& report);

/// The page of a history (history_json), which needs no network either.
std::string history_page(const nlohmann::ordered_json& history);

}  // namespace nearmiss
