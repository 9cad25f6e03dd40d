#include "reports/report.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <string>
#include <string_view>

#include "ccd/query/error.hpp"
#include "corpus/file.hpp"
#include "corpus/query_text.hpp"
#include "reports/csv.hpp"
#include "reports/page/page.hpp"
#include "reports/sections/shown.hpp"
#include "reports/text/json.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr std::string_view data_file = "report.json";
constexpr std::array<std::string_view, 7> fixed_files{
    data_file, "index.html", "statistics.csv", "classes.csv", "distances.csv", "times.csv", "findings.csv"};
constexpr std::array sub_folders{"cases", "farthest"};

/// The sub-folder in which files are written before they are moved to their places. It is inside the report's
/// folder, so that a move is a rename in one file system.
constexpr const char* part_name = ".nearmiss-part";

/// Whether a path, relative to a report's folder, has the form of a file directly in one of `sub_folders`.
bool is_in_sub_folder(const fs::path& path) {
  for (const char* folder : sub_folders)
    if (path.parent_path() == folder) return path.has_filename() && path.filename() != "..";
  return false;
}

/// The report in a file. Throws Error if the file is not a report.
ordered_json read_report(const fs::path& file) {
  constexpr std::string_view expected = "a report, which nearmiss report can replace";
  ordered_json report;
  read_json_file(file, expected, [&](const ordered_json& json) { report = json; });
  for (const char* section : {"headline", "runs", "findings", "farthest"})
    if (!report.is_object() || !report.contains(section))
      throw Error(fmt::format("{}: found no section {}, expected {}", file.string(), section, expected));
  return report;
}

Error not_a_report(const fs::path& folder) {
  return Error(
      fmt::format("{}: found something that is not a report, expected a new folder or an earlier report",
                  folder.string()));
}

/// Throws Error if something is in the way of one of the report's files: a folder, or a file that nearmiss
/// did not write.
void expect_room(const fs::path& folder, const ReportPaths& own,
                 const std::map<std::string, std::string>& files) {
  const auto refuse = [](const fs::path& path) {
    return Error(fmt::format(
        "{}: found a file that nearmiss did not write, expected none where the report has its own",
        path.string()));
  };
  for (const char* sub_folder : sub_folders)
    if (const auto status = fs::symlink_status(folder / sub_folder);
        fs::exists(status) && !fs::is_directory(status))  // refuses links, which may lead to the user's files
      throw refuse(folder / sub_folder);
  for (const auto& [name, content] : files) {
    const auto status = fs::symlink_status(folder / name);
    if (fs::exists(status) && (fs::is_directory(status) || !own.contains(name))) throw refuse(folder / name);
  }
}

/// Writes all files below `part`. Writes report.json last, so that it names only files that were written.
void write_beside(const fs::path& part, const std::map<std::string, std::string>& files) {
  fs::remove_all(part);
  for (const char* sub_folder : sub_folders) fs::create_directories(part / sub_folder);
  for (const auto& [name, content] : files)
    if (name != data_file) replace_file(part / name, content);
  replace_file(part / data_file, files.at(std::string(data_file)));
}

/// Moves all files from `part` to the folder. At every moment, the earlier report.json or the new report.json
/// names each file of the report. So a later call can complete an interrupted replacement.
void put_in_place(const fs::path& part, const fs::path& folder, const ReportPaths& own,
                  const std::map<std::string, std::string>& files) {
  for (const char* sub_folder : sub_folders) fs::create_directories(folder / sub_folder);
  for (const std::string& name : own)
    if (!files.contains(name) && !fs::is_directory(fs::symlink_status(folder / name)))
      fs::remove(folder / name);
  for (const auto& [name, content] : files)
    if (name != data_file) fs::rename(part / name, folder / name);
  fs::rename(part / data_file, folder / data_file);
  fs::remove_all(part);
}

}  // namespace

ReportPaths files_of(const ordered_json& report) {
  ReportPaths files(fixed_files.begin(), fixed_files.end());
  const auto add = [&](const ordered_json& each, const char* field) {
    if (!each.is_object() || !each.contains(field) || !each[field].is_string()) return;
    if (const auto path = each[field].get<std::string>(); is_in_sub_folder(path)) files.insert(path);
  };
  for (const ordered_json& finding : report.at("findings"))
    for (const char* field : {"file", "original_file"}) add(finding, field);
  for (const ordered_json& far : report.at("farthest")) add(far, "file");
  return files;
}

ReportPaths own_files(const fs::path& folder) {
  ReportPaths own;
  try {
    if (!fs::exists(folder)) return own;
    if (!fs::is_directory(folder)) throw not_a_report(folder);
    bool is_report = fs::is_empty(folder) || fs::is_directory(folder / part_name);
    for (const fs::path& file : {folder / data_file, folder / part_name / data_file}) {
      if (!fs::exists(file)) continue;
      own.merge(files_of(read_report(file)));
      is_report = true;
    }
    if (!is_report) throw not_a_report(folder);
  } catch (const fs::filesystem_error& error) {
    throw Error(fmt::format("{}: cannot be read: {}", folder.string(), error.what()));
  }
  return own;
}

void replace_report(const fs::path& folder, const ReportPaths& own,
                    const std::map<std::string, std::string>& files) {
  const fs::path part = folder / part_name;
  expect_room(folder, own, files);
  bool is_written = false;
  try {
    write_beside(part, files);
    is_written = true;
    put_in_place(part, folder, own, files);
  } catch (const std::exception& error) {
    std::error_code ignored;
    // if all files were written, a later call of own_files() will need report.json in `part`
    if (!is_written) {
      fs::remove_all(part, ignored);
      fs::remove(folder, ignored);  // this fails unless the folder is empty, so other files stay
    }
    throw Error(fmt::format("{}: the report cannot be written: {}", folder.string(), error.what()));
  }
}

namespace {

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
