#include "reports/power_table.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "ccd/error.hpp"

namespace nearmiss {

using nlohmann::ordered_json;

ordered_json hunts_json(const std::vector<Hunt>& hunts) {
  ordered_json json = ordered_json::array();
  for (const Hunt& hunt : hunts) {
    ordered_json each{{"subject", hunt.subject}, {"way", hunt.way}, {"failure", nullptr}};
    if (hunt.failure) {
      each["failure"] = *hunt.failure;
      each["seconds"] = hunt.seconds;
      each["cases"] = hunt.cases;
      each["provenance"] = hunt.provenance;
    }
    json.push_back(std::move(each));
  }
  return json;
}

std::vector<Hunt> load_hunts(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw Error(fmt::format("{}: cannot be read", file.string()));
  std::vector<Hunt> hunts;
  try {
    for (const ordered_json& each : ordered_json::parse(in)) {
      Hunt hunt{.subject = each.at("subject"), .way = each.at("way")};
      if (!each.at("failure").is_null()) {
        hunt.failure = each["failure"].get<std::string>();
        hunt.seconds = each.at("seconds");
        hunt.cases = each.at("cases");
        hunt.provenance = each.at("provenance");
      }
      hunts.push_back(std::move(hunt));
    }
  } catch (const ordered_json::exception& error) {
    throw Error(fmt::format("{}: found '{}', expected what nearmiss power --json keeps", file.string(),
                            error.what()));
  }
  return hunts;
}

}  // namespace nearmiss
