// Tests nearmiss simulate, nearmiss distance and nearmiss step as a user sees them.
#include <cstdlib>
#include <numeric>

#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::CommandLine;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST_F(CommandLine, SimulateShowsWhoTanglesTheCloth) {
  EXPECT_THAT(expect_code(0, "simulate --list").out, HasSubstr("\ncloths "));
  const json found = json_of(
      1, "simulate cloths@100 --subject bullet,exact --steps 25 --db s.db --frames frames --no-shrink");
  EXPECT_THAT(read("error.txt"),
              HasSubstr("cloths@100: 72 vertices, 100 triangles, 170 edges, steps of 5ms"));
  EXPECT_THAT(read("error.txt"), ContainsRegex("scene:sim:cloths@100 +steps +rounds"));
  const json& steps = found["simulations"]["scene:sim:cloths@100"];
  const auto sum = [&](const char* subject, const char* counter) {
    const auto list = steps[subject][counter].get<std::vector<int>>();
    EXPECT_EQ(list.size(), 25);
    return std::accumulate(list.begin(), list.end(), 0);
  };
  EXPECT_GT(sum("bullet", "tangled"), 0);
  EXPECT_GT(sum("bullet", "false_negatives"), 0);
  EXPECT_GT(sum("bullet", "unanswered"), 0) << "it does not decide pairs of edges";
  EXPECT_GT(sum("exact", "positives"), 0);
  for (const char* counter : {"unanswered", "tangled", "false_negatives", "false_positives", "unresolved"})
    EXPECT_EQ(sum("exact", counter), 0) << counter;
  const json again = json_of(1, found["runs"][0]["again"].get<std::string>().substr(9));
  for (const char* counter : {"positives", "collisions", "tangled", "picojoules"})
    EXPECT_EQ(again["simulations"]["scene:sim:cloths@100"]["bullet"][counter], steps["bullet"][counter]);
  EXPECT_EQ(report_of("s.db", 1)["pictures"].size(), 2);
  // The folder of a subject's frames is a scene, with the mesh at the start and at the end of each step.
  EXPECT_THAT(run("scene frames/exact --leave-out boxes").out, HasSubstr("exact: 26 frames, 72 vertices"));
  expect_refused("simulate cloths@100 --subject exact --frames frames", {"frames: exists already"});
  expect_refused("simulate cloths@16 --subject 'wang_3=exact,wang@3' --frames new",
                 {"two subjects with the folder wang_3"});
  expect_code(0, "simulate cloths@16 --subject " + plugin("dots") + " --steps 1 --frames inside -q");
  EXPECT_TRUE(std::filesystem::exists(file("inside/_../0001.obj")));
  expect_refused("simulate knots", {"knots: found no scene of that name", "nearmiss simulate --list"});
  for (const char* bad : {"-1", "0", "nan", "inf", "x", "1e999"}) {
    expect_refused(std::string("simulate cloths --stiffness ") + bad,
                   {"--stiffness: found '" + std::string(bad) + "', expected a positive number"});
    expect_refused(std::string("simulate cloths --edge ") + bad, {"--edge: found '" + std::string(bad)});
  }
  expect_refused("simulate cloths --stiffness 1e20",
                 {"found springs of 1e+20 N/m", "expected at most 8e+09 N/m"});
  expect_refused("simulate cloths --step-time 0s", {"--step-time"});
  expect_refused("simulate cloths --steps 10001", {"--steps"});
  expect_refused("simulate cloths --subject basic,wang --versions basic,wang", {"--versions"});
  expect_refused("simulate", {"SCENE is required"});
}

TEST_F(CommandLine, SimulateFailsIfASubjectIsAskedNothing) {
  EXPECT_THAT(expect_code(1, "simulate hair@100 --subject bullet --steps 3").out,
              HasSubstr("FAIL bullet: NOT ASKED"));
}

TEST_F(CommandLine, SimulationsAreAddedUpOnlyIfTheyDiffer) {
  const std::string simulate = "simulate cloths@50 --subject exact --steps 8 -q --db ";
  expect_code(0, simulate + "a.db");
  expect_code(0, simulate + "b.db --stiffness 500 --step-time 2ms");
  expect_code(0, "merge both.db a.db b.db");
  const json both = report_of("both.db")["simulations"];
  EXPECT_EQ(both.size(), 2);
  EXPECT_TRUE(both.contains("scene:sim:cloths@50:stiffness=500:step=2ms"));
  EXPECT_EQ(both["scene:sim:cloths@50"]["exact"]["step"].size(), 8);
  expect_code(0, "simulate cloths@50 --subject exact --steps 9 -q --db c.db");
  EXPECT_THAT(expect_code(2, "report a.db c.db -o twice").error,
              HasSubstr("c.db: found scene:sim:cloths@50 with exact, which another store has too"));
}

/// The example in fuzz/simulation/README.md: two misses of the textbook CCD (basic) tangle two cloths.
TEST_F(CommandLine, SimulateFindsAClothThatATextbookCcdTangles) {
  const json found =
      json_of(1,
              "simulate cloths@64 --stiffness 0.01 --step-time 10ms --steps 8 --subject basic,wang -q "
              "--no-shrink")["simulations"]["scene:sim:cloths@64:stiffness=0.01:step=10ms"];
  const json none(std::vector<int>(8, 0));
  EXPECT_EQ(found["basic"]["false_negatives"], json({0, 0, 0, 0, 0, 2, 0, 0}));
  EXPECT_EQ(found["basic"]["tangled"], json({0, 0, 0, 0, 0, 4, 4, 4}));
  EXPECT_EQ(found["basic"]["unresolved"], none);
  for (const char* counter : {"false_negatives", "tangled", "unresolved"})
    EXPECT_EQ(found["wang"][counter], none) << counter;
}

/// The provenance of a finding (family, seed and number) is enough to make the query again, even if a
/// simulation has asked the query.
TEST_F(CommandLine, FuzzAsksWhatSimulationsAsk) {
  expect_code(1,
              "fuzz --family sim:hair@100:steps-per-frame=1,sim:cloths@50 --subject bullet-double,basic "
              "--cases 2000 -q --no-shrink --db a.db");
  EXPECT_EQ(report_of("a.db", 1)["findings"][0]["class"], "ordinary");
  const std::string findings = read("report/findings.csv");
  const std::string provenance = "sim:cloths@50:1:";  // not hair: bullet decides no pairs of edges
  const std::size_t index = findings.find(provenance) + provenance.size();
  const std::size_t end = findings.find('\n', index);
  const std::string query = expect_code(0, "family sim:cloths@50 --kind vt --count 1 --seed 1 --first " +
                                               findings.substr(index, findings.find(',', index) - index))
                                .out;
  EXPECT_TRUE((findings.substr(index, end - index) + "\n").ends_with("," + query)) << findings;
  EXPECT_THAT(expect_code(0, "family sim:cloths@50 --classes --count 1000").out,
              ContainsRegex("\nvt +ordinary +398 +79.6 % +16 +88.9 %\n"));
  expect_refused("family --kind vt --count 1 sim:knots",
                 {"family 'sim:knots': knots: found no scene of that name"});
  expect_refused("fuzz --cases 10 --kind vt --family sim:hair@100:steps-per-frame=1",
                 {"--kind: found vt, expected ee for the family sim:hair"});
}

class Questions : public CommandLine {
 protected:
  static std::string distances(int defect) {
    return "distance --subject " + plugin("distances") + ":defect=" + std::to_string(defect) + " ";
  }
  static std::string steps(int defect) {
    return "step --subject " + plugin("steps") + ":defect=" + std::to_string(defect) + " ";
  }

  /// Expects that `command`, which asks a function without a defect, finds no failure for any kind of query.
  /// `failures` is the key of the number of failures in the JSON.
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

  /// Takes the query of the simplest failure that `command` finds. Expects that the same function fails again
  /// if it is asked only this query. Expects that the command `right`, which asks a function without a
  /// defect, finds no failure on this query. Expects that the checker accepts the failure's certificate.
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
