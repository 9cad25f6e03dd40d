#include "reports/sections/other_tables.hpp"

#include <array>
#include <utility>

#include "reports/text/json.hpp"
#include "reports/text/json_file.hpp"

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

namespace {

constexpr std::array<std::pair<const char*, std::string Environment::*>, 4> texts{
    {{"subject", &Environment::subject},
     {"compiler", &Environment::compiler},
     {"flags", &Environment::flags},
     {"mode", &Environment::mode}}};
constexpr std::array<std::pair<const char*, std::uint64_t Environment::*>, 6> numbers{
    {{"queries", &Environment::queries},
     {"collisions", &Environment::collisions},
     {"missed", &Environment::missed},
     {"false_positives", &Environment::false_positives},
     {"refuted_bounds", &Environment::refuted_bounds},
     {"faults", &Environment::faults}}};

}  // namespace

ordered_json environments_json(const std::vector<Environment>& environments) {
  ordered_json json = ordered_json::array();
  for (const Environment& each : environments) {
    ordered_json row;
    for (const auto& [key, member] : texts) row[key] = each.*member;
    for (const auto& [key, member] : numbers) row[key] = each.*member;
    row["verdict"] = each.verdict();
    row["first"] = each.first ? ordered_json(*each.first) : ordered_json();
    json.push_back(std::move(row));
  }
  return json;
}

std::vector<Environment> load_environments(const std::filesystem::path& file) {
  std::vector<Environment> environments;
  read_json_file(file, "the table of tools/environments", [&](const ordered_json& json) {
    for (const ordered_json& each : json) {
      Environment row;
      for (const auto& [key, member] : texts) each.at(key).get_to(row.*member);
      for (const auto& [key, member] : numbers) each.at(key).get_to(row.*member);
      if (!each.at("first").is_null()) row.first = each["first"].get<std::string>();
      environments.push_back(std::move(row));
    }
  });
  return environments;
}

}  // namespace nearmiss
