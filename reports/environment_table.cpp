#include "reports/environment_table.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "ccd/error.hpp"

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
  std::ifstream in(file);
  if (!in) throw Error(fmt::format("{}: cannot be read", file.string()));
  std::vector<Environment> environments;
  try {
    for (const ordered_json& each : ordered_json::parse(in)) {
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
  } catch (const ordered_json::exception& error) {
    throw Error(
        fmt::format("{}: found '{}', expected the table of tools/environments", file.string(), error.what()));
  }
  return environments;
}

}  // namespace nearmiss
