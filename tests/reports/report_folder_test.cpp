// A report replaces its own files, and no others.
#include "reports/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "ccd/query/error.hpp"
#include "reports/campaign/finding_case.hpp"
#include "reports/text/json.hpp"
#include "tests/refused.hpp"
#include "tests/reports/campaigns.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::some_campaign;

class ReportFolder : public testing::TemporaryFolder {
 protected:
  void write_report_of(const std::string& subject, const std::string& folder = "report") const {
    write_report(some_campaign(subject), {}, file(folder));
  }

  [[nodiscard]] ReportPaths files_in(const std::string& folder) const {
    ReportPaths files;
    for (const auto& each : fs::recursive_directory_iterator(file(folder)))
      if (!each.is_directory()) files.insert(fs::relative(each.path(), file(folder)).string());
    return files;
  }

  /// Expects that a report of the subject `bad` is refused with an error that contains `words`, and that no
  /// file changes.
  void expect_refused(const std::string& folder, const std::string& words) const {
    const ReportPaths before = files_in(folder);
    std::map<std::string, std::string> contents;
    for (const std::string& each : before) contents[each] = read(fs::path(folder) / each);
    EXPECT_ERROR(write_report_of("bad", folder), AllOf(HasSubstr(folder), HasSubstr(words)));
    EXPECT_EQ(files_in(folder), before);
    for (const auto& [name, content] : contents) EXPECT_EQ(read(fs::path(folder) / name), content) << name;
  }
};

TEST_F(ReportFolder, ReplacesAnEarlierReportAndNothingElse) {
  write_report_of("wang");
  const ReportPaths mine{"letter.txt",  "cases/mine.case", "farthest/mine.case",
                         "notes/a.txt", "index.html.part", "cases/false-negative-other-001.case"};
  for (const std::string& name : mine) write("report/" + name, "precious");
  write_report_of("bad");
  ReportPaths expected = files_of(ordered_json::parse(read("report/report.json")));
  EXPECT_FALSE(expected.contains("cases/false-negative-wang-001.case"));
  EXPECT_TRUE(expected.contains("cases/false-negative-bad-001.case"));
  expected.insert(mine.begin(), mine.end());
  EXPECT_EQ(files_in("report"), expected);
  for (const std::string& name : mine) EXPECT_EQ(read("report/" + name), "precious") << name;
}

TEST_F(ReportFolder, RefusesAFileInItsWay) {
  write_report_of("wang");
  write("report/cases/false-negative-bad-001.case", "precious");
  expect_refused("report", "false-negative-bad-001.case: found a file that nearmiss did not write");
  fs::remove(file("report/cases/false-negative-bad-001.case"));
  write("report/farthest/bad-vt-fam__ily.case/mine.txt", "precious");
  expect_refused("report", "bad-vt-fam__ily.case: found a file that nearmiss did not write");
}

TEST_F(ReportFolder, RefusesALinkInPlaceOfItsFolders) {
  for (const std::string name : {"cases", "farthest"}) {
    const std::string linked = name + "-linked";
    const std::string elsewhere = name + "-elsewhere";
    write_report_of("wang", linked);
    fs::rename(file(linked) / name, file(elsewhere));
    fs::create_directory_symlink(file(elsewhere), file(linked) / name);
    expect_refused(linked, name);
    EXPECT_FALSE(files_in(elsewhere).empty());
  }
}

TEST_F(ReportFolder, HasNamesThatAFileSystemTakes) {
  for (const std::string& name : {std::string(255, 'y') + "1", std::string(255, 'y') + "2"}) {
    write_report_of(name, "report");
    EXPECT_EQ(files_of(ordered_json::parse(read("report/report.json"))), files_in("report"));
  }
  EXPECT_NE(file_name(std::string(255, 'y') + "1"), file_name(std::string(255, 'y') + "2"));
  EXPECT_EQ(file_name(std::string(60, 'y')), std::string(60, 'y'));
  EXPECT_EQ(file_name(std::string(61, 'y')).size(), 60);
}

// File names have '_' in place of ' ' and ';', and some file systems do not distinguish A from a.
TEST_F(ReportFolder, HasAFileForEachCaseOfSubjectsWithSimilarNames) {
  Campaign campaign;
  campaign.runs.push_back({{{"command", "fuzz"}}, {{}}, {}});
  const std::vector<std::string> subjects{"a b", "a;b", "A_b", "a_b-vt-fam__ily", "a_b-vt-fam"};
  for (const std::string& subject : subjects) {
    const Campaign one = some_campaign(subject);
    const Counts& counts = one.statistics.counts.begin()->second;
    for (const char* family : {"fam  ily", "fam;;ily", "fam__ily-2"})
      campaign.statistics.counts[{subject, Kind::vertex_triangle, family}] = counts;
    campaign.runs.front().findings.push_back(one.runs.front().findings.front());
  }
  write_report(campaign, {}, file("report"));
  const auto json = ordered_json::parse(read("report/report.json"));
  std::set<std::string> names;
  for (const char* section : {"findings", "farthest"})
    for (const auto& each : json[section])
      for (const char* key : {"file", "original_file"})
        if (each.contains(key)) {
          std::string name = each[key];
          std::transform(name.begin(), name.end(), name.begin(), ::tolower);
          EXPECT_TRUE(names.insert(name).second) << name;
          EXPECT_THAT(read(fs::path("report") / each[key].get<std::string>()), HasSubstr(each["subject"]));
        }
  EXPECT_EQ(names.size(), subjects.size() * (2 + 3));
}

TEST_F(ReportFolder, RefusesAFolderThatIsNoReport) {
  write("home/letter.txt", "precious");
  expect_refused("home", "found something that is not a report");
  write("other/report.json", R"({"results": []})");
  write("other/index.html", "precious");
  expect_refused("other", "report.json: found no section headline, expected a report");
  write("broken/report.json", "{");
  expect_refused("broken", "expected a report");
}

TEST_F(ReportFolder, AReportThatNamesOtherFilesDoesNotDeleteThem) {
  write_report_of("wang");
  auto json = ordered_json::parse(read("report/report.json"));
  for (const char* name :
       {"../letter.txt", "cases/../../letter.txt", "cases/..", "letter.txt", "/letter.txt"})
    json["findings"].push_back({{"file", name}});
  write("report/report.json", json.dump());
  write("letter.txt", "precious");
  write("report/letter.txt", "precious");
  write_report_of("bad");
  EXPECT_EQ(read("letter.txt"), "precious");
  EXPECT_EQ(read("report/letter.txt"), "precious");
}

TEST_F(ReportFolder, AnInterruptedReplacementIsCompleted) {
  write_report_of("wang");
  write_report_of("bad", "new");
  const fs::path part = file("report/.nearmiss-part");
  fs::copy(file("new"), part, fs::copy_options::recursive);
  // The interrupted replacement had moved only this file to its place.
  const std::string moved = "cases/false-negative-bad-001.case";
  fs::rename(part / moved, file("report") / moved);
  write_report_of("third");
  EXPECT_EQ(files_in("report"), files_of(ordered_json::parse(read("report/report.json"))));
  EXPECT_FALSE(fs::exists(file("report") / moved));
  EXPECT_FALSE(fs::exists(part));
}

TEST_F(ReportFolder, AFailureLeavesTheEarlierReport) {
  write_report_of("wang");
  const std::string before = read("report/report.json");
  const std::map<std::string, std::string> unwritable{{"no/folder.txt", ""}, {"report.json", ""}};
  for (const char* folder : {"report", "absent"})
    EXPECT_REFUSED(replace_report(file(folder), own_files(file(folder)), unwritable),
                   "the report cannot be written");
  EXPECT_FALSE(fs::exists(file("absent")));
  EXPECT_EQ(files_in("report").size(), 7 + 2 + 1);
  EXPECT_EQ(read("report/report.json"), before);
}

}  // namespace
}  // namespace nearmiss
