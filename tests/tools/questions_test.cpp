// nearmiss distance and nearmiss step, as a user sees them.
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::CommandLine;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class Questions : public CommandLine {
 protected:
  static std::string distances(int defect) {
    return "distance --subject " + plugin("distances") + ":defect=" + std::to_string(defect) + " ";
  }
  static std::string steps(int defect) {
    return "step --subject " + plugin("steps") + ":defect=" + std::to_string(defect) + " ";
  }

  /// Expects that a function without a defect fails on no query of any kind. `failures` is the key of the
  /// number of failures.
  void expect_right(const std::string& command, const std::string& heading, const char* failures) const {
    const json all = json_of(0, command + "--cases 4000");
    EXPECT_THAT(read("error.txt"), HasSubstr(heading));
    EXPECT_THAT(read("error.txt"), Not(HasSubstr("the simplest failures")));
    const json& of_kinds = all["subjects"].front();
    EXPECT_EQ(of_kinds.size(), 4U);
    for (const auto& counts : of_kinds) {
      EXPECT_GT(counts["queries"], 100);
      EXPECT_EQ(counts[failures], 0);
      EXPECT_EQ(counts["faults"], 0);
    }
    EXPECT_TRUE(all["findings"].empty());
  }

  /// Expects that the query of a function's simplest failure can be asked again alone, with the same
  /// failure, and that the checker accepts the failure's certificate. `right` is the command for a function
  /// without a defect.
  void expect_finding(const std::string& command, const std::string& right,
                      const std::string& failure) const {
    const json finding = json_of(1, command + "--cases 2000")["findings"][0];
    EXPECT_THAT(read("error.txt"), HasSubstr("ordinary: " + failure + ": "));
    EXPECT_EQ(finding["class"], "ordinary");
    write("query", finding["query"].get<std::string>() + "\n");
    EXPECT_THAT(expect_code(1, command + "query").out,
                StartsWith(failure + " " + finding["answer"].get<std::string>()));
    EXPECT_THAT(expect_code(0, right + "query").out, StartsWith("right "));
    write("certificate", finding["certificate"].get<std::string>() + "\n");
    const std::string check = NEARMISS_PYTHON " " NEARMISS_CHECKER " " + file("certificate").string();
    EXPECT_EQ(std::system((check + " >" + file("said").string()).c_str()), 0) << read("said");
  }
};

TEST_F(Questions, OfARightFunctionShowNoFailure) {
  expect_right(distances(0), "over-reported", "over_reported");
  expect_right(steps(0), "kept, median", "unsafe");
}

TEST_F(Questions, OfAWrongFunctionShowTheSimplestQuery) {
  expect_finding(distances(1) + "--kind vv ", distances(0) + "--kind vv ", "over-reported");
  expect_finding(steps(5) + "--kind vt ", steps(0) + "--kind vt ", "unsafe");
}

TEST_F(Questions, OfTheUnitAreTold) {
  EXPECT_THAT(expect_code(1, distances(5) + "--family rest-units --cases 20000 --no-search --kind vt").out,
              HasSubstr("distances:defect=5 vt: right with edge = 2^-"));
}

TEST_F(Questions, OfAFileHaveOneLineEach) {
  for (const auto& [numbers, code, options, line] :
       std::vector<std::tuple<std::string, int, std::string, std::string>>{
           {"0 0 0  0 0 1  0 0 0  0 0 1", 0, distances(0) + "--kind vv ", "right 0x1p+0 "},
           {"0 0 0 0 0 0.5 0 0 0 0 0 0.5", 0, distances(2) + "--kind vv ", "under-reported 0x1p-2 "},
           {"0 0 1  0 0 0  0 0 0  0 0 1  0 0 0  0 0 0", 1, distances(6) + "--kind ve ",
            "fault ve invalid answer distances:defect=6\n"}}) {
    write("query", numbers + "\n");
    EXPECT_THAT(expect_code(code, options + "query").out, StartsWith(line));
  }
  expect_refused(distances(0) + "--kind ve query --json new.json", {"FILE excludes --json"});
  expect_refused("distance hit.vt --subject " + plugin("distances"), {"--kind: expected the one kind"});
}

TEST_F(Questions, AreInterruptedWhileAFunctionHangs) {
  const std::string stopped = "timeout --preserve-status -s TERM -k 15 1 ";
  expect_code(130, distances(26) + "--kind vv --query-time 60s -q", stopped);
}

TEST_F(Questions, NeedAFunctionThatAnswersThem) {
  for (const std::string command : {"distance", "step"})
    expect_refused(command + " --subject wang --cases 10 --json new.json",
                   {"wang: found no function " + command, "expected a plug-in that has it"});
  expect_refused(distances(0) + "--kind vt --family nonsense --cases 10", {"unknown family 'nonsense'"});
  expect_refused(distances(0) + "--kind vt --family v-rest --cases 10",
                 {"--kind: found vt, expected vv or ve"});
}

TEST_F(Questions, OfDistancesAreASectionOfAReport) {
  expect_code(0, "fuzz --subject wang --cases 100 --db a.db --json other.json");
  expect_code(1, distances(17) + "--cases 2000 --json distances.json");
  const json section = report_of("a.db --distances distances.json")["distances"];
  const json all = read_json("distances.json");
  EXPECT_EQ(section["run"], all["run"]);
  EXPECT_EQ(section["counts"].size(), 4U);
  const json& ee = all["subjects"]["distances:defect=17"]["ee"];
  for (const auto& row : section["counts"]) {
    if (row["kind"] != "ee") continue;
    EXPECT_EQ(row["over_reported"], ee["over_reported"]);
    EXPECT_EQ(row["ordinary"], ee["over_reported_by_class"]["ordinary"]);
    EXPECT_EQ(row["largest_over"], ee["largest_over"]["value"]);
  }
  EXPECT_EQ(section["findings"].size(), all["findings"].size());
  expect_refused("report a.db -o new --distances other.json", {"what nearmiss distance --json keeps"});
}

}  // namespace
}  // namespace nearmiss
