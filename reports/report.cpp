#include "reports/report.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "ccd/error.hpp"
#include "corpus/case.hpp"
#include "corpus/file.hpp"
#include "corpus/query_text.hpp"
#include "reports/csv.hpp"
#include "reports/finding_case.hpp"
#include "reports/page.hpp"
#include "reports/summary.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// Findings that become case files and rows of the page: so many of each subject and sort. All are in
/// findings.csv.
constexpr std::size_t shown_of_each = 50;

/// A finding or a far false positive on its way into cases/.
struct Exported {
  std::string file;
  Case content;
};

/// The findings to show, with their files: the first ones of each subject and sort.
std::vector<std::pair<const Finding*, Exported>> shown_findings(const Campaign& campaign) {
  std::map<std::pair<Finding::What, std::string>, std::size_t> numbers;
  std::vector<std::pair<const Finding*, Exported>> shown;
  for (const Finding& finding : campaign.findings) {
    const std::size_t number = ++numbers[{finding.what, finding.subject}];
    if (number > shown_of_each) continue;
    shown.emplace_back(&finding,
                       Exported{case_file_name(finding, fmt::format("{:03}", number)), to_case(finding)});
  }
  return shown;
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

/// What a finding is, whichever run found it.
auto identity(const Finding& finding) {
  return std::tuple(finding.what, finding.subject, finding.query.kind, finding.query.x);
}

ordered_json rates(const Counts& counts) {
  const std::uint64_t others = counts.queries - counts.collisions;
  ordered_json json;
  json["queries"] = counts.queries;
  json["false_negatives"] = counts.false_negatives;
  json["false_positive_rate"] =
      others == 0 ? 0 : static_cast<double>(counts.false_positives) / static_cast<double>(others);
  json["max_fp_distance_over_bound"] = counts.max_ratio();
  json["ns_per_query"] = counts.timed_queries == 0 ? ordered_json() : ordered_json(counts.ns_per_query());
  return json;
}

ordered_json changes(const Campaign& now, const Campaign& before) {
  ordered_json json;
  json["runs"] = before.runs;
  std::set<decltype(identity(std::declval<const Finding&>()))> known;
  for (const Finding& finding : before.findings) known.insert(identity(finding));
  std::uint64_t fresh = 0;
  for (const Finding& finding : now.findings) fresh += known.contains(identity(finding)) ? 0 : 1;
  json["new_findings"] = fresh;
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
  for (const auto& [finding, each] : shown_findings(campaign))
    write_case(each.content, folder / "cases" / each.file);
  for (const Exported& each : far_cases(campaign.statistics))
    write_case(each.content, folder / "cases" / each.file);
  replace_file(folder / "index.html", report_page(json));
}

}  // namespace

ordered_json report_json(const Campaign& campaign, const std::optional<Campaign>& baseline) {
  ordered_json json = summary_json(campaign);
  json["verdicts"] = ordered_json::array();
  for (const SubjectVerdict& each : subject_verdicts(campaign.statistics))
    json["verdicts"].push_back({{"subject", each.subject}, {"clean", each.clean}, {"text", each.text}});
  json["oracle"]["complaint"] = oracle_complaint(campaign.statistics);
  json["histogram_borders"] = ordered_json::array();
  for (std::size_t i = 0; i <= Histogram::bin_count; ++i)
    json["histogram_borders"].push_back(Histogram::border(i));
  json["findings_total"] = campaign.findings.size();
  json["findings"] = ordered_json::array();
  for (const auto& [finding, each] : shown_findings(campaign))
    json["findings"].push_back({{"what", name(finding->what)},
                                {"subject", finding->subject},
                                {"kind", short_name(finding->query.kind)},
                                {"family", finding->family},
                                {"provenance", finding->provenance},
                                {"ratio", finding->ratio},
                                {"file", "cases/" + each.file}});
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
