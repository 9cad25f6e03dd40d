// The report of a campaign: a folder that people open, and data that scripts read.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "reports/campaign.hpp"

namespace nearmiss {

/// Everything that the page shows: summary_json with the histogram's borders, a verdict for each subject,
/// the findings (the first ones of each signature, with the names of their case files), and, where there is a
/// baseline, what changed since.
nlohmann::ordered_json report_json(const Campaign& campaign, const std::optional<Campaign>& baseline);

/// The ways to fail that the baseline has not.
std::vector<Signature> new_signatures(const Campaign& now, const Campaign& baseline);

/// Writes the folder, whole or not at all:
///  - index.html: self-contained, opens offline; it only draws report.json, which is inside it;
///  - report.json; statistics.csv, distances.csv and findings.csv with everything there is;
///  - cases/: findings, shrunk and as they were found, and the farthest false positives as *.case files, for
///    nearmiss replay.
/// An earlier report is replaced. Throws Error where the folder is something else or cannot be written.
void write_report(const Campaign& campaign, const std::optional<Campaign>& baseline,
                  const std::filesystem::path& folder);

}  // namespace nearmiss
