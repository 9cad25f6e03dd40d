// The report of a campaign: a folder that people open, and data that scripts read.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reports/campaign/campaign.hpp"
#include "reports/sections/baseline.hpp"
#include "reports/sections/other_tables.hpp"
#include "reports/statistics/failure.hpp"

namespace nearmiss {

/// Data that a report shows in addition to its campaign.
struct ReportContext {
  std::optional<Changes> since = {};  ///< the comparison with earlier campaigns
  std::vector<Hunt> hunts = {};       ///< how soon hunts find known defects
  std::string audit = {};             ///< audit of rounding constants, the JSON that nearmiss audit writes
  std::string paper = {};             ///< the paper's claims, the JSON that nearmiss paper writes
  std::string distances = {};         ///< distances of features, from the JSON that nearmiss distance writes
  std::string environments = {};      ///< CCDs in environments, the JSON of load_environments
  Failures failing = usual_failures();  ///< the failures that count
};

/// The version of report.json, which reports/report.schema.json describes.
inline constexpr int report_schema_version = 2;

/// Everything that the page shows: the schema's version; summary_json by shown family (family.hpp); the
/// headline, and a verdict on each subject; error against run time; the histogram's borders, and the names
/// of the stages; the first findings of each signature and the farthest false positives, with the names of
/// their case files; the earliest and latest times; and the sections of `context`.
nlohmann::ordered_json report_json(const Campaign& campaign, const ReportContext& context = {});

/// Writes the files of a report:
///  - index.html: self-contained, opens offline; it contains report.json and only draws it;
///  - report.json;
///  - statistics.csv, classes.csv, distances.csv, times.csv and findings.csv, with all counters and findings;
///  - cases/: findings, shrunk and in their original form, as *.case files for nearmiss replay;
///  - farthest/: the farthest false positive of each subject, kind and family, as *.case files.
/// Replaces the files of an earlier report, and no others (report_folder.hpp). Throws Error if the folder is
/// not that of a report, if another file is in the way, or if the files cannot be written.
void write_report(const Campaign& campaign, const ReportContext& context,
                  const std::filesystem::path& folder);

}  // namespace nearmiss
