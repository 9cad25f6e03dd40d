#include "reports/json.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <set>
#include <utility>

#include "corpus/query_text.hpp"
#include "reports/sections/counts_json.hpp"
#include "reports/sections/sections.hpp"
#include "reports/statistics/family.hpp"
#include "reports/text/json.hpp"
#include "reports/text/shell.hpp"

namespace nearmiss {

using nlohmann::ordered_json;

namespace {

ordered_json extreme_json(const Extreme& extreme) {
  ordered_json json;
  json["of"] = name(extreme.of);
  json["queries"] = extreme.queries;
  json["value"] = extreme.found() ? ordered_json(extreme.value) : ordered_json();
  if (!extreme.found()) return json;
  json["kind"] = short_name(extreme.query.kind);
  json["query"] = to_line(extreme.query);
  json["provenance"] = extreme.provenance;
  return json;
}

/// The command that repeats the results of a run. Nothing if a time limit ended several shards, because no
/// command can repeat that, or if the text in the store is not a single command that stores a run.
std::optional<std::string> command_to_repeat(const Run& run) {
  const std::string again = fact(run.info, "again");
  constexpr std::array that_store_runs{"fuzz ", "ladder ", "replay ", "scene ", "simulate ", "tightness "};
  const bool repeats_a_run = std::ranges::any_of(that_store_runs, [&](const std::string& subcommand) {
    return again.starts_with("nearmiss " + subcommand);
  });
  if (!repeats_a_run || !is_one_command(again)) return std::nullopt;
  if (fact(run.info, "cases") != until_the_time_is_over) return again;
  if (run.shards.size() != 1 || run.shards.front().count != 1) return std::nullopt;
  return fmt::format("{} --first {}", again, run.shards.front().cases);
}

/// The sections that are left out if they are empty.
constexpr std::array<std::pair<const char*, ordered_json (*)(const Statistics&)>, 8> sections{
    {{"sizes", sizes_json},
     {"common_factors", common_factors_json},
     {"versions", versions_json},
     {"scenes", funnels_json},
     {"simulations", simulations_json},
     {"sweeps", sweeps_json},
     {"option_sweeps", option_sweeps_json},
     {"cliffs", cliffs_json}}};

}  // namespace

ordered_json runs_json(const std::vector<Run>& runs) {
  ordered_json json = ordered_json::array();
  for (const Run& run : runs) {
    ordered_json each = run.info;
    each.erase("again");
    std::set<RunInfo> environments;
    std::string started;
    std::uint64_t cases = 0;
    double seconds = 0;
    for (const Shard& shard : run.shards) {
      environments.insert(shard.environment);
      if (started.empty() || shard.started < started) started = shard.started;
      cases += shard.cases;
      seconds += shard.seconds;
    }
    if (const auto again = command_to_repeat(run)) each["again"] = *again;
    if (const std::string missing = missing_shards(run); !missing.empty()) each["missing"] = missing;
    each["environments"] = environments;
    each["cases_done"] = cases;
    each["started"] = started;
    each["seconds"] = seconds;
    json.push_back(std::move(each));
  }
  return json;
}

ordered_json summary_json(const Campaign& campaign) {
  ordered_json json;
  json["runs"] = runs_json(campaign.runs);
  add_campaign_counters(json["oracle"], campaign.statistics);
  for (const auto& [key, counts] : campaign.statistics.oracle)
    json["oracle"]["families"][std::string(short_name(key.first))][key.second] = oracle_json(counts);
  json["oracle"]["total"] = oracle_json(campaign.statistics.oracle_total());
  for (const auto& [name, each] : campaign.statistics.extremes) json["tightness"][name] = extreme_json(each);
  json["signatures"] = ordered_json::array();
  for (const auto& [signature, times] : campaign.statistics.seen)
    json["signatures"].push_back({{"what", name(signature.what)},
                                  {"subject", signature.subject},
                                  {"signature", signature.text},
                                  {"seen", times}});
  json["subjects"] = ordered_json::object();
  const auto of_kind = [&](const std::string& subject, Kind kind) -> ordered_json& {
    return json["subjects"][subject][std::string(short_name(kind))];
  };
  for (const auto& [key, sum] : campaign.statistics.by_subject_and_kind())
    of_kind(key.subject, key.kind) = counts_json(sum);
  for (const auto& [key, sum] : by_class(campaign.statistics))
    of_kind(key.subject, key.kind)["classes"][std::string(name(key.of))] = counts_json(sum);
  for (const auto& [key, counts] : campaign.statistics.counts) {
    ordered_json& family = of_kind(key.subject, key.kind)["families"][key.family];
    family["class"] = name(class_of(key.family));
    family.update(counts_json({counts, is_random(key.family)}));
  }
  for (const auto& [key, section_of] : sections)
    if (ordered_json section = section_of(campaign.statistics); !section.empty())
      json[key] = std::move(section);
  return json;
}

}  // namespace nearmiss
