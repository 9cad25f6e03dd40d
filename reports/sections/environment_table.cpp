#include "reports/sections/environment_table.hpp"

#include <nlohmann/json.hpp>

#include "reports/sections/json_file.hpp"

namespace nearmiss {

using nlohmann::ordered_json;

ordered_json environments_json(const std::vector<Environment>& environments) {
  ordered_json json = ordered_json::array();
  for (const Environment& each : environments)
    json.push_back({{"subject", each.subject},
                    {"compiler", each.compiler},
                    {"flags", each.flags},
                    {"mode", each.mode},
                    {"queries", each.queries},
                    {"collisions", each.collisions},
                    {"missed", each.missed},
                    {"false_positives", each.false_positives},
                    {"refuted_bounds", each.refuted_bounds},
                    {"faults", each.faults},
                    {"verdict", each.verdict()},
                    {"first", each.first ? ordered_json(*each.first) : ordered_json()}});
  return json;
}

std::vector<Environment> load_environments(const std::filesystem::path& file) {
  std::vector<Environment> environments;
  read_json_file(file, "the table of tools/environments", [&](const ordered_json& json) {
    for (const ordered_json& each : json) {
      Environment row{.subject = each.at("subject"),
                      .compiler = each.at("compiler"),
                      .flags = each.at("flags"),
                      .mode = each.at("mode"),
                      .queries = each.at("queries"),
                      .collisions = each.at("collisions"),
                      .missed = each.at("missed"),
                      .false_positives = each.at("false_positives"),
                      .refuted_bounds = each.at("refuted_bounds"),
                      .faults = each.at("faults")};
      if (!each.at("first").is_null()) row.first = each["first"].get<std::string>();
      environments.push_back(std::move(row));
    }
  });
  return environments;
}

}  // namespace nearmiss
