#include "reports/sections/power_table.hpp"

#include <nlohmann/json.hpp>

#include "reports/sections/json_file.hpp"

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
  std::vector<Hunt> hunts;
  read_json_file(file, "what nearmiss power --json keeps", [&](const ordered_json& json) {
    for (const ordered_json& each : json) {
      Hunt hunt{.subject = each.at("subject"), .way = each.at("way")};
      if (!each.at("failure").is_null()) {
        hunt.failure = each["failure"].get<std::string>();
        hunt.seconds = each.at("seconds");
        hunt.cases = each.at("cases");
        hunt.provenance = each.at("provenance");
      }
      hunts.push_back(std::move(hunt));
    }
  });
  return hunts;
}

}  // namespace nearmiss
