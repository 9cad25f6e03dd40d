#include "reports/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "corpus/query_text.hpp"
#include "oracle/distance.hpp"
#include "oracle/explanation.hpp"
#include "oracle/oracle.hpp"
#include "reports/campaign/finding_case.hpp"
#include "reports/sections/baseline.hpp"
#include "reports/sections/headline.hpp"
#include "reports/sections/measures.hpp"
#include "reports/sections/sections.hpp"
#include "reports/sections/shown.hpp"
#include "reports/sections/verdicts.hpp"
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

/// The command that repeats the results of a run. Nothing if the run has several shards and was ended by a
/// time limit, because no single command can repeat such a run. Also nothing if the fact "again" is not a
/// single nearmiss command that stores a run.
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

/// The sections that report.json lacks if they are empty.
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

namespace {

/// The time at which the page draws a query: the earliest time at which the primitives collide or, if they do
/// not collide, the time at which they are closest.
double moment(const Query& query) {
  auto earliest = earliest_time(query);
  return earliest ? earliest->enclosure().lo : closest_time(query);
}

/// The coordinates of a query, then its separation unless it is 0, as in a query file.
ordered_json numbers_json(const Query& query) {
  ordered_json json = coordinate_list(query);
  if (query.separation != 0) json.push_back(query.separation);
  return json;
}

ordered_json finding_json(const Campaign& campaign, const ShownFinding& each, bool is_new) {
  const Finding& finding = each.finding;
  ordered_json json{{"what", name(finding.what)},
                    {"subject", finding.subject},
                    {"signature", finding.signature},
                    {"new", is_new},
                    {"seen", each.seen},
                    {"kind", short_name(finding.query.kind)},
                    {"family", finding.family},
                    {"provenance", finding.provenance},
                    {"is_shrunk", finding.is_shrunk},
                    {"ratio", finding.what == Finding::What::late ? 0 : finding.ratio},
                    {"class", name(finding.query_class)},
                    {"shrunk", numbers_json(finding.shrunk)},
                    {"simplest", numbers_json(finding.simplest)},
                    {"simplest_class", name(finding.simplest_class)},
                    {"explanation", to_text(explain(finding.shrunk))},
                    {"time", moment(finding.shrunk)},
                    {"original", numbers_json(finding.query)},
                    {"again", replay_command(campaign, each)},
                    {"file", "cases/" + each.shrunk.file},
                    {"original_file", "cases/" + each.original.file}};
  json["certificate"] = finding.certificate.empty() ? ordered_json() : ordered_json(finding.certificate);
  if (finding.what == Finding::What::refuted_bound) json["bound"] = finding.bound;
  if (!finding.broken_since.empty()) json["broken_since"] = finding.broken_since;
  if (finding.what == Finding::What::late) json["late_by"] = finding.ratio;
  if (!finding.errors.empty()) json["errors"] = error_lines(finding);
  if (has_time(finding.what)) json["toi"] = finding.time;
  if (has_step(finding.what)) json["step"] = numbers_json(finding.step);
  return json;
}

ordered_json farthest_json(const ShownFarthest& each) {
  return {{"subject", each.key.subject},
          {"kind", short_name(each.key.kind)},
          {"family", each.key.family},
          {"shown_family", shown_family(each.key.family)},
          {"class", name(class_of(each.key.family))},
          {"ratio", each.far.ratio},
          {"bound_of_distances", name(each.unit)},
          {"provenance", each.far.provenance},
          {"query", numbers_json(each.far.query)},
          {"time", moment(each.far.query)},
          {"file", "farthest/" + each.exported.file}};
}

/// For each subject and kind with times of impact: the time that is farthest before t* (the exact earliest
/// time), and the time that is farthest after t*.
ordered_json extreme_times_json(const Statistics& statistics) {
  ordered_json json = ordered_json::array();
  for (const auto& [key, sum] : statistics.by_subject_and_kind())
    for (const auto& [is_early, cases] :
         {std::pair{true, &sum.counts.earliest}, std::pair{false, &sum.counts.latest}}) {
      if (cases->empty()) continue;
      const FarCase& far = cases->front();
      const double time = moment(far.query);
      const double given = is_early ? time - far.ratio : time + far.ratio;  // as precise as far.ratio
      json.push_back({{"subject", key.subject},
                      {"kind", short_name(key.kind)},
                      {"side", is_early ? "early" : "after"},
                      {"error", far.ratio},
                      {"provenance", far.provenance},
                      {"query", numbers_json(far.query)},
                      {"time", time},
                      {"toi", std::clamp(given, 0.0, 1.0)}});
    }
  return json;
}

ordered_json before_and_now(const Statistics& now, const Statistics& before) {
  ordered_json json = ordered_json::array();
  const auto earlier = before.by_subject_and_kind();
  for (const auto& [key, sum] : now.by_subject_and_kind()) {
    const auto same = earlier.find(key);
    json.push_back({{"subject", key.subject},
                    {"kind", short_name(key.kind)},
                    {"now", rates_json(sum)},
                    {"before", same == earlier.end() ? ordered_json() : rates_json(same->second)}});
  }
  return json;
}

/// The lower borders of all bins of a Histogram; the last bin has no upper border.
ordered_json borders_json() {
  ordered_json json = ordered_json::array();
  for (std::size_t i = 0; i < Histogram::bin_count; ++i) json.push_back(Histogram::border(i));
  return json;
}

/// The names of the stages that can accept a query, in the order of the enumeration Stage.
ordered_json stages_json() {
  ordered_json json = ordered_json::array();
  for (const std::string_view each : stage_names)
    if (each != stage_names[static_cast<std::size_t>(Stage::none)]) json.push_back(each);
  return json;
}

ordered_json findings_json(const Campaign& campaign, const std::vector<ShownFinding>& findings,
                           const std::optional<Changes>& since) {
  ordered_json json = ordered_json::array();
  for (const ShownFinding& each : findings) {
    const bool is_new = since && std::binary_search(since->new_signatures.begin(),
                                                    since->new_signatures.end(), signature_of(each.finding));
    json.push_back(finding_json(campaign, each, is_new));
  }
  return json;
}

void add_pictures(ordered_json& json, const Campaign& campaign) {
  for (const Run& run : campaign.runs)
    for (const ScenePicture& picture : run.pictures) {
      json["pictures"].push_back({{"step", picture.step}});
      json["pictures"].back().update(ordered_json::parse(picture.json));
    }
}

/// Adds the sections of a report that come from other commands and from the comparison with the baseline.
void add_context(ordered_json& json, const Statistics& statistics, const ReportContext& context) {
  const auto add = [&](const char* section, const std::string& text) {
    if (!text.empty()) json[section] = ordered_json::parse(text);
  };
  add("audit", context.audit);
  add("paper", context.paper);
  add("distances", context.distances);
  if (!context.hunts.empty()) json["power"] = hunts_json(context.hunts);
  add("environments", context.environments);
  if (!context.since) return;
  const Campaign& baseline = context.since->baseline;
  json["baseline"] = changes_json(*context.since);
  json["baseline"]["runs"] = runs_json(baseline.runs);
  json["baseline"]["subjects"] = before_and_now(statistics, baseline.statistics);
}

}  // namespace

ordered_json report_json(const Campaign& campaign, const ReportContext& context) {
  const Statistics& statistics = campaign.statistics;
  ordered_json json{{"schema_version", report_schema_version}};
  json.update(summary_json({campaign.runs, by_shown_family(statistics)}));
  const Headline line = headline(statistics, context.since, context.failing);
  json["headline"] = {{"clean", line.clean}, {"text", line.text}, {"alarms", line.alarms}};
  const std::vector<ShownFinding> findings = shown_findings(campaign);
  json["verdicts"] = scorecard_json(statistics, findings, context.since, context.failing);
  json["oracle"]["complaint"] = oracle_complaint(statistics);
  json["error_against_time"] = trade_offs_json(statistics);
  json["histogram_borders"] = borders_json();
  json["stages"] = stages_json();
  json["findings_total"] = campaign.findings().size();
  json["findings"] = findings_json(campaign, findings, context.since);
  json["farthest"] = ordered_json::array();
  for (const ShownFarthest& each : farthest_cases(statistics))
    json["farthest"].push_back(farthest_json(each));
  json["extreme_times"] = extreme_times_json(statistics);
  if (auto rows = deciders_json(statistics); !rows.empty()) json["deciders"] = std::move(rows);
  if (auto ladder = ladder_json(statistics); !ladder.empty()) json["ladder"] = std::move(ladder);
  add_pictures(json, campaign);
  add_context(json, statistics, context);
  return json;
}

}  // namespace nearmiss
