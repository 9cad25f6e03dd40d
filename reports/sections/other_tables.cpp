#include "reports/sections/other_tables.hpp"

#include <utility>

#include "reports/text/json.hpp"

namespace nearmiss {

using nlohmann::ordered_json;

ordered_json hunts_json(const std::vector<Hunt>& hunts) {
  ordered_json json = ordered_json::array();
  for (const Hunt& hunt : hunts) {
    ordered_json each{{"subject", hunt.subject},
                      {"way", hunt.way},
                      {"time", hunt.time},
                      {"seed", hunt.seed},
                      {"failure", nullptr}};
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
      Hunt hunt{.subject = each.at("subject"),
                .way = each.at("way"),
                .time = each.at("time"),
                .seed = each.at("seed")};
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

std::string load_environments(const std::filesystem::path& file) {
  ordered_json rows = ordered_json::array();
  read_json_file(file, "the table of tools/environments", [&](const ordered_json& json) {
    for (const ordered_json& each : json) {
      ordered_json& row = rows.emplace_back();
      for (const char* key : {"subject", "compiler", "flags", "mode"})
        row[key] = each.at(key).get<std::string>();
      for (const char* key :
           {"queries", "collisions", "missed", "false_positives", "refuted_bounds", "faults"})
        row[key] = each.at(key).get<std::uint64_t>();
      row["verdict"] = row["missed"] > 0 ? "misses" : row["faults"] > 0 ? "gives no answer" : "keeps it";
      row["first"] = each.at("first");
      if (!row["first"].is_null()) row["first"].get_ref<const std::string&>();  // or throws
    }
  });
  return rows.empty() ? "" : json_text(rows);
}

}  // namespace nearmiss
