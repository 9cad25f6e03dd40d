#include "reports/report.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "ccd/error.hpp"
#include "corpus/case.hpp"
#include "corpus/file.hpp"
#include "corpus/query_text.hpp"
#include "oracle/oracle.hpp"
#include "reports/csv.hpp"
#include "reports/finding_case.hpp"
#include "reports/page.hpp"
#include "reports/summary.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// Findings that become case files and rows of the page: so many of each signature. All are in findings.csv.
constexpr std::size_t shown_of_each = 3;

/// A case on its way into cases/.
struct Exported {
  std::string file;
  Case content;
};

/// A finding on its way there and into the page: its shrunk query, and the query that was found.
struct Shown {
  Finding finding;
  std::uint64_t seen;
  Exported shrunk, original;
};

Shown shown(const Finding& finding, std::uint64_t seen, std::size_t number) {
  Finding simplest = finding;
  simplest.query = finding.shrunk;
  simplest.ratio = 0;  // that of the query that was found
  simplest.provenance = "shrunk from " + finding.provenance;
  const auto exported = [&](const Finding& what, std::string_view suffix) {
    Exported result{case_file_name(what, fmt::format("{:03}{}", number, suffix)), to_case(what)};
    result.content.why += fmt::format(": {}; times seen: {}", finding.signature, with_separators(seen));
    return result;
  };
  Shown result{finding, seen, exported(simplest, ""), exported(finding, "-original")};
  result.original.content.why += "; before it was shrunk";
  return result;
}

/// When to show a query: at its first contact, or where there is none when it is closest to one.
double moment(const Query& query) {
  const auto contact = earliest_time(query, 1e-6);
  return contact ? contact->enclosure.lo : closest_time(query);
}

/// The findings to show, the first ones of each signature, with files numbered for each subject and sort.
std::vector<Shown> shown_findings(const Campaign& campaign) {
  std::map<Signature, std::size_t> count;
  std::map<std::pair<Finding::What, std::string>, std::size_t> number;
  std::vector<Shown> result;
  for (Finding& finding : campaign.findings())
    if (++count[signature_of(finding)] <= shown_of_each)
      result.push_back(
          shown(finding, campaign.statistics.times_seen(finding), ++number[{finding.what, finding.subject}]));
  return result;
}

std::vector<Exported> far_cases(const Statistics& statistics) {
  std::vector<Exported> cases;
  for (const auto& [key, counts] : statistics.by_subject_and_kind()) {
    std::size_t number = 0;
    for (const FarCase& far : counts.farthest) {
      ++number;
      cases.push_back(
          {file_name(fmt::format("far-{}-{}-{}.case", key.subject, short_name(key.kind), number)),
           {.name = {},
            .query = far.query,
            .truth = false,
            .why = fmt::format("false positive of {}, at {:.3g} of the bound", key.subject, far.ratio),
            .provenance = far.provenance}});
    }
  }
  return cases;
}

ordered_json rates(const Counts& counts) {
  ordered_json json;
  json["queries"] = counts.queries;
  json["false_negatives"] = counts.false_negatives;
  json["false_positive_rate"] = counts.false_positive_rate();
  json["max_fp_distance_over_bound"] = counts.max_ratio();
  json["ns_per_query"] = counts.timed_queries == 0 ? ordered_json() : ordered_json(counts.ns_per_query());
  return json;
}

ordered_json changes(const Campaign& now, const Campaign& before) {
  ordered_json json;
  json["runs"] = runs_json(before.runs);
  json["new_signatures"] = ordered_json::array();
  for (const Signature& each : new_signatures(now, before))
    json["new_signatures"].push_back(
        {{"what", name(each.what)}, {"subject", each.subject}, {"signature", each.text}});
  json["changes"] = ordered_json::array();
  const auto earlier = before.statistics.by_subject_and_kind();
  for (const auto& [key, counts] : now.statistics.by_subject_and_kind()) {
    const auto same = earlier.find(key);
    json["changes"].push_back({{"subject", key.subject},
                               {"kind", short_name(key.kind)},
                               {"now", rates(counts)},
                               {"before", same == earlier.end() ? ordered_json() : rates(same->second)}});
  }
  return json;
}

void fill_folder(const Campaign& campaign, const std::optional<Campaign>& baseline, const fs::path& folder) {
  fs::create_directories(folder / "cases");
  const ordered_json json = report_json(campaign, baseline);
  replace_file(folder / "report.json", json.dump(1) + "\n");
  replace_file(folder / "statistics.csv", statistics_csv(campaign.statistics));
  replace_file(folder / "distances.csv", distances_csv(campaign.statistics));
  replace_file(folder / "findings.csv", findings_csv(campaign));
  for (const Shown& each : shown_findings(campaign))
    for (const Exported& exported : {each.shrunk, each.original})
      write_case(exported.content, folder / "cases" / exported.file);
  for (const Exported& each : far_cases(campaign.statistics))
    write_case(each.content, folder / "cases" / each.file);
  replace_file(folder / "index.html", report_page(json));
}

}  // namespace

std::vector<Signature> new_signatures(const Campaign& now, const Campaign& baseline) {
  std::vector<Signature> fresh;
  for (const auto& [signature, times] : now.statistics.seen)
    if (!baseline.statistics.seen.contains(signature)) fresh.push_back(signature);
  return fresh;
}

ordered_json report_json(const Campaign& campaign, const std::optional<Campaign>& baseline) {
  ordered_json json = summary_json(campaign);
  json["verdicts"] = ordered_json::array();
  for (const SubjectVerdict& each : subject_verdicts(campaign.statistics))
    json["verdicts"].push_back({{"subject", each.subject}, {"clean", each.clean}, {"text", each.text}});
  json["oracle"]["complaint"] = oracle_complaint(campaign.statistics);
  json["histogram_borders"] = ordered_json::array();
  for (std::size_t i = 0; i <= Histogram::bin_count; ++i)
    json["histogram_borders"].push_back(Histogram::border(i));
  json["findings_total"] = campaign.findings().size();
  json["findings"] = ordered_json::array();
  for (const Shown& each : shown_findings(campaign))
    json["findings"].push_back({{"what", name(each.finding.what)},
                                {"subject", each.finding.subject},
                                {"signature", each.finding.signature},
                                {"seen", each.seen},
                                {"kind", short_name(each.finding.query.kind)},
                                {"family", each.finding.family},
                                {"provenance", each.finding.provenance},
                                {"ratio", each.finding.ratio},
                                {"shrunk", each.finding.shrunk.x},
                                {"time", moment(each.finding.shrunk)},
                                {"original", each.finding.query.x},
                                {"file", "cases/" + each.shrunk.file},
                                {"original_file", "cases/" + each.original.file}});
  if (baseline) json["baseline"] = changes(campaign, *baseline);
  return json;
}

void write_report(const Campaign& campaign, const std::optional<Campaign>& baseline, const fs::path& folder) {
  const fs::path whole = folder.has_filename() ? folder : folder.parent_path();
  if (fs::exists(whole) &&
      !(fs::is_directory(whole) && (fs::is_empty(whole) || fs::exists(whole / "report.json"))))
    throw Error(fmt::format(
        "{}: found something that is no report, expected a new folder or an earlier report", whole.string()));
  const fs::path part = whole.string() + ".part";
  try {
    fs::remove_all(part);
    fill_folder(campaign, baseline, part);
    fs::remove_all(whole);
    fs::rename(part, whole);
  } catch (const std::exception& error) {
    std::error_code ignored;
    fs::remove_all(part, ignored);
    throw Error(fmt::format("{}: the report cannot be written: {}", whole.string(), error.what()));
  }
}

}  // namespace nearmiss
