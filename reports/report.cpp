#include "reports/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "ccd/error.hpp"
#include "corpus/case.hpp"
#include "corpus/file.hpp"
#include "corpus/query_text.hpp"
#include "oracle/oracle.hpp"
#include "reports/baseline.hpp"
#include "reports/csv.hpp"
#include "reports/finding_case.hpp"
#include "reports/headline.hpp"
#include "reports/json.hpp"
#include "reports/page.hpp"
#include "reports/shell.hpp"
#include "reports/summary.hpp"
#include "reports/trade_off.hpp"

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

/// The farthest false positive of one subject, kind and family.
struct Farthest {
  Key key;
  const FarCase* far;
  Exported exported;
};

std::vector<Farthest> farthest_cases(const Statistics& statistics) {
  std::vector<Farthest> cases;
  for (const auto& [key, counts] : statistics.counts) {
    if (counts.farthest.empty()) continue;
    const FarCase& far = counts.farthest.front();
    cases.push_back(
        {key,
         &far,
         {file_name(fmt::format("{}-{}-{}.case", key.subject, short_name(key.kind), key.family)),
          {.name = {},
           .query = far.query,
           .truth = false,
           .why = fmt::format("false positive of {}, at {:.3g} of the bound", key.subject, far.ratio),
           .provenance = far.provenance}}});
  }
  return cases;
}

/// The run that a finding is of; nothing where it came from elsewhere.
const Run* run_of(const Campaign& campaign, const Finding& finding) {
  for (const Run& run : campaign.runs)
    if (std::find(run.findings.begin(), run.findings.end(), finding) != run.findings.end()) return &run;
  return nullptr;
}

/// Where the machine that found it had a subject's plug-in; nothing for a built-in subject.
std::optional<std::string> plugin_path(const Run& run, const std::string& subject) {
  for (const Part& part : run.parts)
    if (const auto path = part.environment.find("plug-in " + subject); path != part.environment.end())
      return path->second;
  return std::nullopt;
}

/// The command that shows a finding again, run in the report's folder.
std::string replay_command(const Campaign& campaign, const Shown& shown) {
  std::string command = fmt::format("nearmiss replay cases/{}", shown.shrunk.file);
  const std::string& subject = shown.finding.subject;
  if (subject.empty()) return command + " --compare 1";
  const Run* const run = run_of(campaign, shown.finding);
  const auto path = run == nullptr ? std::nullopt : plugin_path(*run, subject);
  command += fmt::format(" --subject {}", shell_quoted(path.value_or(subject)));
  if (run == nullptr) return command;
  for (const char* option : {"bound", "query-time", "query-memory"})
    if (const auto given = run->info.find(option);
        given != run->info.end() && (path || given->first == "bound"))
      command += fmt::format(" --{} {}", option, given->second);
  return command;
}

ordered_json finding_json(const Campaign& campaign, const Shown& each, bool is_new) {
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

ordered_json farthest_json(const Farthest& each) {
  return {{"subject", each.key.subject},        {"kind", short_name(each.key.kind)},
          {"family", each.key.family},          {"ratio", each.far->ratio},
          {"provenance", each.far->provenance}, {"query", each.far->query.x},
          {"time", moment(each.far->query)},    {"file", "farthest/" + each.exported.file}};
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
  for (const Shown& each : shown_findings(campaign))
    for (const Exported& exported : {each.shrunk, each.original})
      write_case(exported.content, folder / "cases" / exported.file);
  for (const Farthest& each : farthest_cases(campaign.statistics))
    write_case(each.exported.content, folder / "farthest" / each.exported.file);
  replace_file(folder / "index.html", report_page(json));
}

}  // namespace

ordered_json report_json(const Campaign& campaign, const ReportContext& context) {
  ordered_json json = summary_json(campaign);
  std::optional<Changes> since;
  if (context.baseline) since = changes(campaign, *context.baseline);
  const Headline line = headline(campaign.statistics, since);
  json["headline"] = {{"clean", line.clean}, {"text", line.text}};
  json["verdicts"] = ordered_json::array();
  for (const SubjectVerdict& each : subject_verdicts(campaign.statistics))
    json["verdicts"].push_back({{"subject", each.subject}, {"clean", each.clean}, {"text", each.text}});
  json["oracle"]["complaint"] = oracle_complaint(campaign.statistics);
  json["error_against_time"] = trade_offs_json(campaign.statistics);
  json["histogram_borders"] = ordered_json::array();
  for (std::size_t i = 0; i <= Histogram::bin_count; ++i)
    json["histogram_borders"].push_back(Histogram::border(i));
  json["findings_total"] = campaign.findings().size();
  json["findings"] = ordered_json::array();
  for (const Shown& each : shown_findings(campaign)) {
    const bool is_new =
        context.baseline && !context.baseline->statistics.seen.contains(signature_of(each.finding));
    json["findings"].push_back(finding_json(campaign, each, is_new));
  }
  json["farthest"] = ordered_json::array();
  for (const Farthest& each : farthest_cases(campaign.statistics))
    json["farthest"].push_back(farthest_json(each));
  if (!context.hunts.empty()) json["power"] = hunts_json(context.hunts);
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
