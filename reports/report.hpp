// The report of a campaign: a folder that people open, and data that scripts read.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "reports/campaign/campaign.hpp"
#include "reports/sections/baseline.hpp"
#include "reports/sections/other_tables.hpp"
#include "reports/statistics/failure.hpp"

namespace nearmiss {

/// The JSON of `replay --json` and `fuzz --json`, on which users' scripts depend: subjects.NAME.KIND with
/// queries, collisions, positives, false_negatives, false_positives, max_fp_distance_over_bound and
/// ns_per_query (null if nothing was timed); oracle.disagreements and oracle.mismatches_with_recorded_truth;
/// sweeps if there are any (sections/sections.hpp); and other fields.
nlohmann::ordered_json summary_json(const Campaign& campaign);

/// The runs as JSON. The object of a run has the run's facts, the command that repeats the run, the number of
/// decided cases, the missing shards, the time at which the run began, the run time of all shards together,
/// and a list of the different environments of the shards.
nlohmann::ordered_json runs_json(const std::vector<Run>& runs);

/// JUnit's XML: a suite for each subject, with a test for each kind and class of families. A test fails if
/// its counters have one of the failures in `failing`. The text of a failed test describes its failures in
/// words, and has at most three queries in the form that nearmiss replay reads, and the commands that repeat
/// the runs. If the oracle failed, the file also has a suite "oracle", which fails.
std::string junit_xml(const Campaign& campaign, const Failures& failing = usual_failures());

/// Lines that GitHub's workflows show as annotations: one for each failure of a subject or of the oracle.
std::string github_annotations(const Campaign& campaign, const Failures& failing = usual_failures());

/// Data that a report shows in addition to the results of its campaign.
struct ReportContext {
  std::optional<Changes> since = {};  ///< the comparison with earlier campaigns
  std::vector<Hunt> hunts = {};       ///< searches for known defects
  std::string audit = {};      ///< the audit of rounding constants, as the JSON that nearmiss audit writes
  std::string paper = {};      ///< the test of the paper's claims, as the JSON that nearmiss paper writes
  std::string distances = {};  ///< distances of features, taken from the JSON that nearmiss distance writes
  /// the results of CCDs in environments, as the JSON that load_environments returns
  std::string environments = {};
  Failures failing = usual_failures();  ///< the failures that count
};

/// The version of report.json, which reports/report.schema.json describes.
inline constexpr int report_schema_version = 2;

/// report.json, which has everything that the page shows: the schema's version; the members of summary_json,
/// with the counters summed by shown family (shown_family in family.hpp); the headline, and a verdict on each
/// subject; error against run time; the borders of histogram bins, and the names of the stages
/// (ccd/wang/verdict.hpp); the first findings of each signature and the farthest false positives, with the
/// names of their case files; the earliest and latest times of impact; and the sections of `context`.
nlohmann::ordered_json report_json(const Campaign& campaign, const ReportContext& context = {});

/// Writes the files of a report:
///  - index.html: self-contained, opens offline; it contains report.json and only draws it;
///  - report.json;
///  - statistics.csv, classes.csv, distances.csv, times.csv and findings.csv, with all counters and findings;
///  - cases/: findings, shrunk and in their original form, as *.case files for nearmiss replay;
///  - farthest/: the farthest false positive of each subject, kind and family, as *.case files.
/// Replaces the files of an earlier report, and no others (replace_report). Throws Error if the folder is
/// not that of a report, if another file is in the way, or if the files cannot be written.
void write_report(const Campaign& campaign, const ReportContext& context,
                  const std::filesystem::path& folder);

/// Paths of files in a report's folder, such as "cases/a.case".
using ReportPaths = std::set<std::string>;

/// The paths of all files in the folder of a report whose report.json is `report`: the files with fixed
/// names, and the cases that report.json names.
ReportPaths files_of(const nlohmann::ordered_json& report);

/// The files in a folder that belong to an earlier report, even if the writing of that report was
/// interrupted. The set is empty if the folder is empty or does not exist. Throws Error if the folder is not
/// that of a report.
ReportPaths own_files(const std::filesystem::path& folder);

/// Replaces the files `own` in a folder by `files`, a map from paths to contents; changes no other file.
/// Writes all files to a temporary sub-folder, then moves them into the folder, report.json last. The next
/// call completes an interrupted replacement. Throws Error, before it replaces any file, if another file is
/// in the way or the files cannot be written.
void replace_report(const std::filesystem::path& folder, const ReportPaths& own,
                    const std::map<std::string, std::string>& files);

}  // namespace nearmiss
