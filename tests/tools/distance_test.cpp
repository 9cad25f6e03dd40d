// nearmiss distance, as a user sees it.
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::CommandLine;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;

class Distance : public CommandLine {
 protected:
  static std::string distances(int defect) {
    return "distance --subject " + plugin("distances") + ":defect=" + std::to_string(defect) + " ";
  }
};

TEST_F(Distance, OfARightFunctionShowsErrorsAndNoFailure) {
  const Output output = expect_code(0, distances(0) + "--cases 4000 --json new.json");
  EXPECT_THAT(output.out, HasSubstr("over-reported"));
  EXPECT_THAT(output.out, Not(HasSubstr("the simplest failures")));
  const json all = read_json("new.json");
  EXPECT_EQ(all["run"]["command"], "distance");
  const json& of_kinds = all["subjects"]["distances:defect=0"];
  EXPECT_EQ(of_kinds.size(), 4U);
  for (const auto& counts : of_kinds) {
    EXPECT_GT(counts["queries"], 200);
    EXPECT_EQ(counts["over_reported"], 0);
    EXPECT_EQ(counts["faults"], 0);
  }
  EXPECT_TRUE(all["findings"].empty());
}

TEST_F(Distance, ThatIsTooLargeIsShownWithTheSimplestQuery) {
  const Output output = expect_code(1, distances(1) + "--cases 2000 --kind vv --json new.json");
  EXPECT_THAT(output.out, HasSubstr("distances:defect=1 vv vertex-vertex, ordinary: over-reported: "));
  const json finding = read_json("new.json")["findings"][0];
  EXPECT_EQ(finding["class"], "ordinary");
  // The finding can be asked again by itself, and its certificate is accepted by the checker.
  write("query", finding["query"].get<std::string>() + "\n");
  const Output again = expect_code(1, distances(1) + "--kind vv query");
  EXPECT_EQ(again.out.find("over-reported " + finding["answer"].get<std::string>()), 0U) << again.out;
  EXPECT_EQ(expect_code(0, distances(0) + "--kind vv query").out.find("right "), 0U);
  write("certificate", finding["certificate"].get<std::string>() + "\n");
  const std::string check = NEARMISS_PYTHON " " NEARMISS_CHECKER " " + file("certificate").string();
  EXPECT_EQ(std::system((check + " >" + file("said").string()).c_str()), 0) << read("said");
}

TEST_F(Distance, OfTheUnitIsTold) {
  const Output output =
      expect_code(1, distances(5) + "--family rest-units --cases 20000 --no-search --kind vt");
  EXPECT_THAT(output.out, HasSubstr("distances:defect=5 vt: right with edge = 2^-"));
}

TEST_F(Distance, WithoutAnAnswerIsAFault) {
  const Output output = expect_code(1, distances(6) + "--family degenerate --cases 2000 --no-search");
  EXPECT_THAT(output.out, HasSubstr("invalid answer, degenerate: fault"));
}

TEST_F(Distance, OfAFileMayBeTooSmall) {
  write("query", "0 0 0  0 0 1  0 0 0  0 0 1\n");
  EXPECT_EQ(expect_code(0, distances(0) + "--kind vv query").out.find("right 0x1p+0 "), 0U);
  write("query", "0 0 0 0 0 0.5 0 0 0 0 0 0.5\n");
  EXPECT_EQ(expect_code(0, distances(2) + "--kind vv query").out.find("under-reported 0x1p-2 "), 0U);
  write("query", "0 0 1  0 0 0  0 0 0  0 0 1  0 0 0  0 0 0\n");
  EXPECT_THAT(expect_code(1, distances(6) + "--kind ve query").out,
              MatchesRegex("fault ve invalid answer distances:defect=6\n"));
  expect_refused(distances(0) + "--kind ve query --json new.json", {"FILE excludes --json"});
}

TEST_F(Distance, IsInterruptedWhileAFunctionHangs) {
  const std::string stopped = "timeout --preserve-status -s TERM -k 15 1 ";
  EXPECT_EQ(run(distances(26) + "--kind vv --query-time 60s -q", stopped).code, 130);
}

TEST_F(Distance, NeedsAFunctionThatGivesIt) {
  expect_refused("distance --subject wang --cases 10 --json new.json",
                 {"wang: found no function distance", "expected a plug-in that has it"});
  expect_refused(distances(0) + "--kind vt --family nonsense --cases 10", {"unknown family 'nonsense'"});
  expect_refused(distances(0) + "--kind vt --family v-rest --cases 10",
                 {"--kind: found vt, expected vv or ve"});
  write("query", hit);
  expect_refused("distance query --subject " + plugin("distances"), {"--kind: expected the one kind"});
}

TEST_F(Distance, OfAReportIsASection) {
  expect_code(0, "fuzz --subject wang --cases 100 --db a.db");
  expect_code(1, distances(17) + "--cases 2000 --json distances.json");
  expect_code(0, "report a.db -o report --distances distances.json");
  const json section = read_json("report/report.json")["distances"];
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
  expect_code(0, "fuzz --subject wang --cases 100 --json other.json");
  expect_refused("report a.db -o new --distances other.json", {"what nearmiss distance --json keeps"});
}

}  // namespace
}  // namespace nearmiss
