// The report of a campaign: a folder that people open, and data that scripts read.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reports/campaign.hpp"
#include "reports/environment_table.hpp"
#include "reports/power_table.hpp"

namespace nearmiss {

/// What a report shows beside its campaign, where there is any.
struct ReportContext {
  std::optional<Campaign> baseline = {};
  std::vector<Hunt> hunts = {};  ///< for known defects
  std::string audit = {};        ///< of rounding constants (audit_table.hpp)
  std::vector<Environment> environments = {};
};

/// Everything that the page shows: summary_json by shown family (family.hpp), with a headline, a verdict for
/// each subject, error against run time, the histogram's borders, the findings (the first ones of each
/// signature) and the farthest false positives with the names of their case files, and, where there is a
/// baseline, what changed since.
nlohmann::ordered_json report_json(const Campaign& campaign, const ReportContext& context = {});

/// Writes the folder, whole or not at all:
///  - index.html: self-contained, opens offline; it only draws report.json, which is inside it;
///  - report.json; statistics.csv, distances.csv and findings.csv with everything there is;
///  - cases/: findings, shrunk and as they were found, as *.case files for nearmiss replay;
///  - farthest/: of each subject, kind and family the farthest false positive, likewise.
/// An earlier report is replaced. Throws Error where the folder is something else or cannot be written.
void write_report(const Campaign& campaign, const ReportContext& context,
                  const std::filesystem::path& folder);

}  // namespace nearmiss
