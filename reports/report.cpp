#include "reports/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "ccd/error.hpp"
#include "corpus/file.hpp"
#include "corpus/query_text.hpp"
#include "oracle/oracle.hpp"
#include "reports/baseline.hpp"
#include "reports/csv.hpp"
#include "reports/decider_table.hpp"
#include "reports/family.hpp"
#include "reports/headline.hpp"
#include "reports/json.hpp"
#include "reports/ladder.hpp"
#include "reports/page.hpp"
#include "reports/shown.hpp"
#include "reports/summary.hpp"
#include "reports/trade_off.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// When to show a query: at its first contact, or where there is none when it is closest to one.
double moment(const Query& query) {
  const auto contact = earliest_time(query, 1e-6);
  return contact ? contact->enclosure.lo : closest_time(query);
}

ordered_json finding_json(const Campaign& campaign, const ShownFinding& each, bool is_new) {
  const Finding& finding = each.finding;
  return {{"what", name(finding.what)},
          {"subject", finding.subject},
          {"signature", finding.signature},
          {"new", is_new},
          {"seen", each.seen},
          {"kind", short_name(finding.query.kind)},
          {"family", finding.family},
          {"provenance", finding.provenance},
          {"ratio", finding.ratio},
          {"shrunk", finding.shrunk.x},
          {"time", moment(finding.shrunk)},
          {"original", finding.query.x},
          {"again", replay_command(campaign, each)},
          {"file", "cases/" + each.shrunk.file},
          {"original_file", "cases/" + each.original.file}};
}

ordered_json farthest_json(const ShownFarthest& each) {
  return {{"subject", each.key.subject},
          {"kind", short_name(each.key.kind)},
          {"family", each.key.family},
          {"shown_family", shown_family(each.key.family)},
          {"ratio", each.far.ratio},
          {"provenance", each.far.provenance},
          {"query", each.far.query.x},
          {"time", moment(each.far.query)},
          {"file", "farthest/" + each.exported.file}};
}

/// How each subject and kind did in the baseline and does now.
ordered_json before_and_now(const Statistics& now, const Statistics& before) {
  ordered_json json = ordered_json::array();
  const auto earlier = before.by_subject_and_kind();
  for (const auto& [key, counts] : now.by_subject_and_kind()) {
    const auto same = earlier.find(key);
    json.push_back({{"subject", key.subject},
                    {"kind", short_name(key.kind)},
                    {"now", rates_json(counts)},
                    {"before", same == earlier.end() ? ordered_json() : rates_json(same->second)}});
  }
  return json;
}

void fill_folder(const Campaign& campaign, const ReportContext& context, const fs::path& folder) {
  fs::create_directories(folder / "cases");
  fs::create_directories(folder / "farthest");
  const ordered_json json = report_json(campaign, context);
  replace_file(folder / "report.json", json.dump(1) + "\n");
  replace_file(folder / "statistics.csv", statistics_csv(campaign.statistics));
  replace_file(folder / "distances.csv", distances_csv(campaign.statistics));
  replace_file(folder / "findings.csv", findings_csv(campaign));
  for (const ShownFinding& each : shown_findings(campaign))
    for (const Exported& exported : {each.shrunk, each.original})
      write_case(exported.content, folder / "cases" / exported.file);
  for (const ShownFarthest& each : farthest_cases(campaign.statistics))
    write_case(each.exported.content, folder / "farthest" / each.exported.file);
  replace_file(folder / "index.html", report_page(json));
}

}  // namespace

ordered_json report_json(const Campaign& campaign, const ReportContext& context) {
  ordered_json json = summary_json({campaign.runs, by_shown_family(campaign.statistics)});
  std::optional<Changes> since;
  if (context.baseline) since = changes(campaign, *context.baseline);
  const Headline line = headline(campaign.statistics, since);
  json["headline"] = {{"clean", line.clean}, {"text", line.text}};
  json["verdicts"] = ordered_json::array();
  for (const SubjectVerdict& each : subject_verdicts(campaign.statistics)) {
    const LadderPlace place = place_of(each.subject);
    json["verdicts"].push_back({{"subject", each.subject},
                                {"clean", each.clean},
                                {"text", each.text},
                                {"algorithm", place.algorithm},
                                {"scalar", place.scalar},
                                {"epsilon", std::exp2(place.epsilon_exponent)}});
  }
  json["oracle"]["complaint"] = oracle_complaint(campaign.statistics);
  json["error_against_time"] = trade_offs_json(campaign.statistics);
  json["histogram_borders"] = ordered_json::array();
  for (std::size_t i = 0; i < Histogram::bin_count; ++i)
    json["histogram_borders"].push_back(Histogram::border(i));  // the last bin has no upper one
  json["findings_total"] = campaign.findings().size();
  json["findings"] = ordered_json::array();
  for (const ShownFinding& each : shown_findings(campaign)) {
    const bool is_new = since && std::binary_search(since->new_signatures.begin(),
                                                    since->new_signatures.end(), signature_of(each.finding));
    json["findings"].push_back(finding_json(campaign, each, is_new));
  }
  json["farthest"] = ordered_json::array();
  for (const ShownFarthest& each : farthest_cases(campaign.statistics))
    json["farthest"].push_back(farthest_json(each));
  if (auto rows = deciders_json(campaign.statistics); !rows.empty()) json["deciders"] = std::move(rows);
  if (const auto ladder = ladder_json(campaign.statistics)) json["ladder"] = *ladder;
  for (const Run& run : campaign.runs)
    for (const ScenePicture& picture : run.pictures) {
      json["pictures"].push_back({{"step", picture.step}});
      json["pictures"].back().update(ordered_json::parse(picture.json));
    }
  if (!context.audit.empty()) json["audit"] = ordered_json::parse(context.audit);
  if (!context.hunts.empty()) json["power"] = hunts_json(context.hunts);
  if (!context.environments.empty()) json["environments"] = environments_json(context.environments);
  if (since) {
    json["baseline"] = changes_json(*since);
    json["baseline"]["runs"] = runs_json(context.baseline->runs);
    json["baseline"]["subjects"] = before_and_now(campaign.statistics, context.baseline->statistics);
  }
  return json;
}

void write_report(const Campaign& campaign, const ReportContext& context, const fs::path& folder) {
  const fs::path whole = folder.has_filename() ? folder : folder.parent_path();
  if (fs::exists(whole) &&
      !(fs::is_directory(whole) && (fs::is_empty(whole) || fs::exists(whole / "report.json"))))
    throw Error(fmt::format(
        "{}: found something that is no report, expected a new folder or an earlier report", whole.string()));
  const fs::path part = whole.string() + ".part";
  try {
    fs::remove_all(part);
    fill_folder(campaign, context, part);
    fs::remove_all(whole);
    fs::rename(part, whole);
  } catch (const std::exception& error) {
    std::error_code ignored;
    fs::remove_all(part, ignored);
    throw Error(fmt::format("{}: the report cannot be written: {}", whole.string(), error.what()));
  }
}

}  // namespace nearmiss
