#include "reports/report.hpp"

#include <map>
#include <string>

#include "corpus/query_text.hpp"
#include "reports/csv.hpp"
#include "reports/page/page.hpp"
#include "reports/report_folder.hpp"
#include "reports/sections/shown.hpp"
#include "reports/text/json.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// All files of the report.
std::map<std::string, std::string> files_with_contents(const Campaign& campaign,
                                                       const ReportContext& context) {
  const ordered_json json = report_json(campaign, context);
  std::map<std::string, std::string> files{{"index.html", report_page(json)},
                                           {"report.json", json_text(json, 1) + "\n"},
                                           {"statistics.csv", statistics_csv(campaign.statistics)},
                                           {"classes.csv", classes_csv(campaign.statistics)},
                                           {"distances.csv", distances_csv(campaign.statistics)},
                                           {"times.csv", times_csv(campaign.statistics)},
                                           {"findings.csv", findings_csv(campaign)}};
  for (const ShownFinding& each : shown_findings(campaign))
    for (const Exported& exported : {each.shrunk, each.original})
      files["cases/" + exported.file] = to_text(exported.content);
  for (const ShownFarthest& each : farthest_cases(campaign.statistics))
    files["farthest/" + each.exported.file] = to_text(each.exported.content);
  return files;
}

}  // namespace

void write_report(const Campaign& campaign, const ReportContext& context, const fs::path& folder) {
  const fs::path whole = folder.has_filename() ? folder : folder.parent_path();
  const ReportPaths own = own_files(whole);
  replace_report(whole, own, files_with_contents(campaign, context));
}

}  // namespace nearmiss
