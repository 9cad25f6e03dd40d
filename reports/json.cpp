#include "reports/json.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "corpus/query_text.hpp"
#include "reports/confidence.hpp"
#include "reports/funnel.hpp"
#include "reports/sweep.hpp"

namespace nearmiss {

using nlohmann::ordered_json;

ordered_json rates_json(const Counts& counts) {
  ordered_json json;
  json["queries"] = counts.queries;
  json["collisions"] = counts.collisions;
  json["false_negatives"] = counts.false_negatives;
  json["false_negative_rate"] = counts.false_negative_rate();
  json["false_negative_rate_upper_95"] = nullptr;
  json["false_positives"] = counts.false_positives;
  json["false_positive_rate"] = counts.false_positive_rate();
  json["false_positive_rate_interval_95"] = nullptr;
  if (counts.is_sample) {
    const Interval of_false_positives = clopper_pearson(counts.false_positives, counts.others());
    json["false_negative_rate_upper_95"] = clopper_pearson_upper(counts.false_negatives, counts.collisions);
    json["false_positive_rate_interval_95"] = {of_false_positives.lo, of_false_positives.hi};
  }
  json["refuted_bounds"] = counts.refuted_bounds;
  const auto range = [](const Bin& bin) { return ordered_json{bin.from, bin.to}; };
  json["median_fp_distance_over_bound"] = range(counts.ratio_quantile(0.5));
  json["q99_fp_distance_over_bound"] = range(counts.ratio_quantile(0.99));
  json["max_fp_distance_over_bound"] = counts.max_ratio();
  json["ns_per_query"] =
      counts.times.queries() == 0 ? ordered_json() : ordered_json(counts.times.ns_per_query());
  return json;
}

namespace {

/// Of counts that have names those that are not 0.
template <std::size_t n>
ordered_json by_name(const std::array<std::uint64_t, n>& counts, const std::array<std::string_view, n>& names,
                     std::size_t first = 0) {
  ordered_json json = ordered_json::object();
  for (std::size_t i = first; i < n; ++i)
    if (counts[i] != 0) json[std::string(names[i])] = counts[i];
  return json;
}

/// Everything that is told of times, but for ns_per_query.
ordered_json times_json(const Times& times) {
  ordered_json json;
  json["timed_queries"] = times.queries();
  if (times.queries() != 0) json["mean_ns"] = times.mean();
  json["sampled"] = times.each.total();
  if (times.each.total() == 0) return json;
  for (const auto& [name, part] : {std::pair{"median_ns", 0.5}, {"q99_ns", 0.99}, {"q99.9_ns", 0.999}})
    json[name] = times.each.quantile(part);
  for (const SlowCase& slow : times.slowest)
    json["slowest"].push_back(
        {{"ns", slow.nanoseconds}, {"provenance", slow.provenance}, {"query", to_line(slow.query)}});
  return json;
}

ordered_json counts_json(const Counts& counts) {
  ordered_json json = rates_json(counts);
  json["positives"] = counts.positives;
  json["faults"] = by_name(counts.faults, fault_names, 1);
  json["times"] = times_json(counts.times);
  json["true_positives_by_stage"] = by_name(counts.true_by_stage, stage_names);
  json["false_positives_by_stage"] = by_name(counts.false_by_stage, stage_names);
  json["rejected_by"] = by_name(counts.rejected_by, rejection_names);
  json["fp_distance_histogram"] = counts.distances.bins;
  json["farthest"] = ordered_json::array();
  for (const FarCase& far : counts.farthest)
    json["farthest"].push_back(
        {{"ratio", far.ratio}, {"provenance", far.provenance}, {"query", to_line(far.query)}});
  return json;
}

ordered_json oracle_json(const OracleCounts& counts) {
  ordered_json json;
  json["queries"] = counts.queries;
  json["collisions"] = counts.collisions;
  for (std::size_t i = 0; i < filter_stage_count; ++i)
    json["decided_by"][std::string(filter_stage_names[i])] = counts.by_stage[i];
  json["near_bounds"] = counts.near_bounds;
  json["compared"] = counts.compared;
  json["compared_collisions"] = counts.compared_collisions;
  json["missed_by_parity"] = counts.missed_by_parity;
  return json;
}

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

}  // namespace

namespace {

/// The command that gives the same results; nothing where shards were stopped by the clock, each for itself.
std::optional<std::string> command_to_repeat(const Run& run) {
  const auto again = run.info.find("again");
  if (again == run.info.end()) return std::nullopt;
  const auto cases = run.info.find("cases");
  if (cases == run.info.end() || cases->second != until_the_time_is_over) return again->second;
  if (run.parts.size() != 1 || run.parts.front().shards != 1) return std::nullopt;
  return fmt::format("{} --cases {}", again->second, run.parts.front().cases);
}

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
    for (const Part& part : run.parts) {
      environments.insert(part.environment);
      if (started.empty() || part.started < started) started = part.started;
      cases += part.cases;
      seconds += part.seconds;
    }
    if (const auto again = command_to_repeat(run)) each["again"] = *again;
    if (const std::string missing = missing_parts(run); !missing.empty()) each["missing"] = missing;
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
  json["oracle"]["disagreements"] = campaign.statistics.oracle_disagreements;
  json["oracle"]["mismatches_with_recorded_truth"] = campaign.statistics.mismatches_with_recorded_truth;
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
  for (const auto& [key, counts] : campaign.statistics.by_subject_and_kind())
    json["subjects"][key.subject][std::string(short_name(key.kind))] = counts_json(counts);
  for (const auto& [key, counts] : campaign.statistics.counts)
    json["subjects"][key.subject][std::string(short_name(key.kind))]["families"][key.family] =
        counts_json(counts);
  if (auto funnels = funnels_json(campaign.statistics); !funnels.empty()) json["scenes"] = std::move(funnels);
  if (auto sweeps = sweeps_json(campaign.statistics); !sweeps.empty()) json["sweeps"] = std::move(sweeps);
  return json;
}

}  // namespace nearmiss
