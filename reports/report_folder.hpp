// The folder of a report: which files in it are the report's own, and how they are replaced.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>

namespace nearmiss {

/// Paths of files in a report's folder, such as "cases/a.case".
using ReportPaths = std::set<std::string>;

/// The files of the report with this report.json: those with fixed names, and the cases that report.json
/// names.
ReportPaths files_of(const nlohmann::ordered_json& report);

/// The files in a folder that belong to an earlier report, even if its writing was interrupted; none if the
/// folder is empty or does not exist. Throws Error if the folder is not that of a report.
ReportPaths own_files(const std::filesystem::path& folder);

/// Replaces the files `own` in a folder by `files`, a map from paths to contents; changes no other file.
/// Writes all files under temporary names and then renames them, report.json last. The next call completes
/// an interrupted replacement. Throws Error, before it replaces any file, if another file is in the way or
/// the files cannot be written.
void replace_report(const std::filesystem::path& folder, const ReportPaths& own,
                    const std::map<std::string, std::string>& files);

}  // namespace nearmiss
