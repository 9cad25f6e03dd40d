// Tests the command line as a user sees it: answers and exit codes.
#include <algorithm>

#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using testing::CommandLine;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::MatchesRegex;
using ::testing::Not;
using ::testing::StartsWith;

TEST_F(CommandLine, OracleAnswersByEveryMethod) {
  write("q.vt", hit + miss);
  // The vertex goes through the triangle and back. Root parity cannot distinguish two roots from none.
  write("even.vt", "-0.375 -0.3125 0.25  0 0 0  1 -1 0  1 0 1   1.125 0.4375 0.25  0 0 0  1 1 0  -1 0 1\n");
  for (const std::string method : {"filtered", "exact", "certificate", "parity", "all"}) {
    EXPECT_EQ(run("oracle --kind vt q.vt --method " + method).out, "1\n0\n") << method;
    EXPECT_EQ(run("oracle --kind vt even.vt --method " + method).out, method == "parity" ? "0\n" : "1\n")
        << method;
  }
}

TEST_F(CommandLine, OracleSaysWhatAMethodDoesNotKnow) {
  // The triangle is degenerate: it is an edge. The distance between the vertex and this edge is smallest at
  // the time t with 2 t² = 1. Then the distance is exactly 1.
  write("q.vt", "0 -.5 1  -1 0 0  1 0 0  -1 0 0   -1 -.5 1  -1 -1 0  1 1 0  -1 -1 0   1\n");
  EXPECT_EQ(run("oracle --kind vt q.vt").out, "1\n");
  EXPECT_EQ(expect_code(1, "oracle --kind vt q.vt --method certificate").out, "-\n");
}

TEST_F(CommandLine, OraclePrintsTimeAndDistance) {
  write("q.vt", "# two queries\n" + hit + "\n" + miss);
  EXPECT_EQ(run("oracle --kind vt --toi - <q.vt").out, "1 0x1p-1 0x1p-1\n0 inf inf\n");
  EXPECT_THAT(run("oracle --kind vt --toi --distance q.vt").out,
              MatchesRegex("1 0x1p-1 0x1p-1 0x0p\\+0 0x0p\\+0\n0 inf inf 0x[^ ]* 0x[^ ]*\n"));
}

TEST_F(CommandLine, ACampaignCountsAPluginsCrashesAndHangsAndContinues) {
  std::string again;
  for (const std::string way : {"crash", "hang"}) {
    const int code = way == "hang" ? 0 : 1;
    const json counts = json_of(code, "fuzz --family planted --cases 1000 --query-time 20ms --db " + way +
                                          ".db --subject " + plugin(way))["subjects"]["misbehaving"]["ee"];
    EXPECT_THAT(read("error.txt"), HasSubstr(way == "hang" ? "SLOW in " : "NO ANSWER ("));
    EXPECT_EQ(read("error.txt").find("\n    stderr: ?[31mlast words\n") == std::string::npos, way == "hang");
    EXPECT_EQ(counts["queries"], 500);
    const int faults = counts["faults"][way == "hang" ? "time" : way];
    EXPECT_GT(faults, 0);
    EXPECT_EQ(counts["positives"].get<int>() + faults, 500);
    const json finding = report_of(way + ".db", code)["findings"][0];
    EXPECT_EQ(finding["what"], "fault");
    const json lines = finding.value("errors", json::array());
    EXPECT_EQ(std::count(lines.begin(), lines.end(), "?[31mlast words"), way == "hang" ? 0 : 1);
    again = finding["again"];
  }
  // The command in the report, run in the report's folder, makes a stored query fail again.
  EXPECT_THAT(again, MatchesRegex("nearmiss replay cases/fault-misbehaving-001.case --subject "
                                  "/.*hang.so --query-time 20ms --query-memory [0-9]+"));
  expect_code(1, again.substr(9), "cd report &&");
  expect_code(0,
              "shrink report/cases/fault-misbehaving-001.case --query-time 20ms --subject " + plugin("hang"));
}

TEST_F(CommandLine, AReportHasSeveralStoresAsItsBaseline) {
  for (const std::string seed : {"1", "2", "3"})
    expect_code(0, "fuzz --cases 1100 --seed " + seed + " --db " + seed + ".db");
  const json baseline = report_of("--baseline 1.db --baseline 2.db 3.db")["baseline"];
  ASSERT_EQ(baseline["runs"].size(), 2);
  EXPECT_TRUE(baseline["new_signatures"].empty());
  for (const json& subject : baseline["subjects"])
    EXPECT_EQ(subject["before"]["queries"], 2 * subject["now"]["queries"].get<int>());
  expect_refused("report 3.db --baseline 1.db --baseline 1.db -o report", {"run with seed 1 twice"});
}

TEST_F(CommandLine, FuzzSweepsParameters) {
  const json sweeps =
      json_of(0, "fuzz --sweep needle,end-contact --steps 3 --cases 600 --subject wang,exact")["sweeps"];
  EXPECT_THAT(read("error.txt"), HasSubstr("exact along needle@x"));
  EXPECT_EQ(sweeps["end-contact"]["exact"].size(), 3);
  const json& steps = sweeps["needle"]["wang"];
  ASSERT_EQ(steps.size(), 3);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(steps[i]["value"], (std::array{-16, -8, 0})[i]);
    EXPECT_EQ(steps[i]["queries"], 100);
  }
}

TEST_F(CommandLine, FuzzSweepsAllFamiliesOfTheKindsThatASubjectDecides) {
  const auto swept = [&](const std::string& options) {
    std::set<std::string> names;
    const json sweeps = json_of(0, "fuzz --steps 2 --cases 2000 --no-shrink " + options)["sweeps"];
    for (const auto& [name, ignored] : sweeps.items()) names.insert(name);
    return names;
  };
  const auto of_wang = swept("--sweep all --subject wang");
  EXPECT_THAT(of_wang, IsSupersetOf({"stiff", "needle", "v-drifting", "v-stiff~drawn"}));
  EXPECT_THAT(of_wang, Not(Contains("uniform")));  // this family has no parameter
  const auto of_vertices = swept("--sweep vertices --subject wang");
  EXPECT_THAT(of_vertices, ::testing::Each(StartsWith("v-")));
  EXPECT_THAT(of_wang, IsSupersetOf(of_vertices));
  EXPECT_THAT(swept("--sweep all --subject exact"), Not(Contains(StartsWith("v-"))));
}

TEST_F(CommandLine, ASceneWithoutUndecidedPairsIsNoSuccessBecauseNothingWasAsked) {
  write("flat.obj", two_triangles("1"));
  expect_code(0, "scene flat.obj flat.obj --plan-only");
  EXPECT_THAT(
      expect_code(1, "scene flat.obj flat.obj").out,
      HasSubstr("no subject was asked, neither about the pairs, which the plan decides (--leave-out boxes "
                "asks about them), nor around them\n"));
}

// In this mesh, no two edges could meet.
TEST_F(CommandLine, FuzzTakesAMeshWithPairsOfOneKind) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.25 0.25 ";
  write("above.obj", triangle + "1\nf 1 2 3\n");
  write("below.obj", triangle + "-1\nf 1 2 3\n");
  for (const std::string kind : {"", " --kind vt"}) {
    const json of =
        json_of(0, "fuzz --mesh above.obj below.obj --family mesh --cases 40" + kind)["subjects"]["wang"];
    EXPECT_EQ(of["vt"]["queries"], 40) << kind;
  }
  expect_refused("fuzz --mesh above.obj below.obj --family mesh --cases 40 --kind ee",
                 {"--kind: found ee, expected vt"});
}

TEST_F(CommandLine, FuzzTakesPairsOfAMesh) {
  write_falling_triangle();
  const std::string mesh = "fuzz --mesh start.obj end.obj ";
  const auto queries = [](const json& results, const char* kind) {
    return results["subjects"]["wang"][kind]["families"]["mesh"]["queries"];
  };
  EXPECT_EQ(queries(json_of(0, mesh + "--cases 400 --family mesh"), "ee"), 200);
  EXPECT_EQ(json_of(0, mesh + "--cases 400 --sweep mesh --steps 2")["sweeps"]["mesh"]["wang"].size(), 2);
  EXPECT_GT(queries(json_of(0, mesh + "--cases 500"), "vt"), 0);
}

TEST_F(CommandLine, SceneComparesAllPairs) {
  write_falling_triangle("0.5 1");
  const std::string scene = "scene start.obj end.obj --around 0 ";
  const json subjects =
      json_of(0, scene + "--leave-out boxes --bound pair,scene,100 --export pairs")["subjects"];
  EXPECT_EQ(subjects.size(), 4);  // wang is asked with three bounds; basic uses no bound
  for (const char* name : {"basic", "wang", "wang@100"})
    EXPECT_EQ(subjects[name]["vt"]["collisions"], 3) << name;
  expect_refused(scene + "--export pairs", {"pairs.vt: exists already"});
  const json replayed = json_of(0, "replay pairs.vt pairs.ee --subject wang")["subjects"];
  for (const char* kind : {"vt", "ee"})
    for (const char* count : {"queries", "collisions", "positives", "false_positives"})
      EXPECT_EQ(replayed["wang"][kind][count], subjects["wang"][kind][count]);
  // The triangles only translate, so the plan decides all pairs and asks no subject.
  const json funnel = json_of(0, scene + "--verify-plan")["scenes"]["scene:start"]["vt"];
  EXPECT_THAT(read("error.txt"), HasSubstr("plan verified: "));
  EXPECT_EQ(funnel["asked"], 0);
  EXPECT_EQ(funnel["touching"], 3);
  EXPECT_THAT(expect_code(0, scene + "--leave-out boxes --thickness 1e9 --subject wang").out,
              HasSubstr("contact thickness 1e+09\nsubject"));
  EXPECT_THAT(expect_code(1, scene + "--thickness 1 --subject wang").out,
              HasSubstr("contact thickness 1: no pair needs a subject\n"));
}

TEST_F(CommandLine, SceneAsksAroundItsPairsIfTheyShowLittle) {
  write_falling_triangle("0.5 1");
  const std::string scene = "scene start.obj end.obj --leave-out boxes --subject wang";
  const json families = json_of(0, scene)["subjects"]["wang"]["vt"]["families"];
  EXPECT_EQ(families["mesh"]["queries"], 5000);
  EXPECT_THAT(
      read("error.txt"),
      AllOf(
          HasSubstr("wang: the scene's 3 collisions show little: a miss rate below 63 % at 95 % confidence\n"
                    "around its pairs, 10,000 queries of the family mesh: wang missed 0 of "),
          HasSubstr("nearmiss fuzz --subject wang --mesh start.obj end.obj --family mesh")));
  // Findings about queries around the scene's pairs do not replace findings about the pairs themselves.
  expect_code(1, "scene spikes@100 --subject " + plugin("never") + " --around 300 --db a.db");
  std::set<std::string> seen;
  for (const json& finding : report_of("a.db", 1)["findings"])
    EXPECT_TRUE(seen.insert(finding["provenance"].get<std::string>() + std::string(finding["what"])).second);
  expect_refused(scene + " --around -3", {"--around"});
  EXPECT_FALSE(json_of(0, scene + " --around 0")["subjects"]["wang"]["vt"]["families"].contains("mesh"));
}

TEST_F(CommandLine, PrintsWhatMattersInTwelveLinesAndTheRestOnRequest) {
  const std::string fuzz = "fuzz --subject basic,wang,exact --cases 1000";
  const std::string brief = expect_code(1, fuzz).out;
  EXPECT_LE(std::count(brief.begin(), brief.end(), '\n'), 12) << brief;
  EXPECT_THAT(brief,
              AllOf(HasSubstr("\nthe simplest:\n  false-negative basic "),
                    HasSubstr("\nmore: --db FILE keeps the results for nearmiss report; -v shows tables\n")));
  EXPECT_THAT(expect_code(1, fuzz + " -v").out,
              AllOf(HasSubstr("ns/query\n"), HasSubstr("\nthe first findings:\n")));
}

TEST_F(CommandLine, NamesTheNearestOption) {
  expect_refused("fuzz --case 5",
                 {"found the option '--case', expected one such as '--cases' (see nearmiss fuzz --help)"});
  expect_refused("replay", {"PATH is required (see nearmiss replay --help)"});
}

TEST_F(CommandLine, ScenesAreBuiltInToo) {
  EXPECT_THAT(expect_code(0, "scene --list").out, HasSubstr("\nknot "));
  const json scenes = json_of(1, "scene flying@300 --subject wang")["scenes"];
  EXPECT_THAT(read("error.txt"), HasSubstr("flying@300: 21 frames, "));
  EXPECT_EQ(scenes.size(), 20);
  EXPECT_TRUE(scenes.contains("scene:flying@300#19"));
  expect_refused("scene flying@9", {"flying@9: found size 9, expected 100 to 4000000"});
  expect_refused("scene flyings", {"flyings: found neither a folder nor a scene", "nearmiss scene --list"});
  expect_refused("scene", {"SCENE is required"});
  // A path to a folder means this folder, even if a built-in scene has the same name.
  write("flying/1.obj", two_triangles("1"));
  write("flying/2.obj", two_triangles("-1"));
  EXPECT_THAT(run("scene ./flying").out, HasSubstr("flying: 2 frames, 6 vertices"));
}

TEST_F(CommandLine, ShrinkWritesACaseThatFailsInTheSameWay) {
  write("q.vt", "0.3 0.37 1.1  0.1 0 0  1.7 0 0.2  0 1.3 0   0.31 0.2 -1.9  0 0.01 0  1.1 0 0.3  0 1.2 0\n");
  const std::string never = " --subject " + plugin("never");
  const Output output = expect_code(0, "shrink q.vt" + never);
  EXPECT_THAT(output.out, StartsWith("# false-negative of always: vt simple-root inside in-face\n"
                                     "# distinct numbers: 11 -> "));
  EXPECT_THAT(output.out, HasSubstr("kind vt\ntruth 1\nprovenance shrunk from q.vt:1\nx0 "));
  const Output silent = run("shrink q.vt -o shrunk.case" + never);
  EXPECT_THAT(silent.out,
              MatchesRegex("distinct numbers: 11 -> [12]; their significant bits: 578 -> [1-4]\n"));
  EXPECT_EQ(read("shrunk.case"), output.out);
  expect_code(1, "replay shrunk.case" + never);
  expect_code(0, "shrink shrunk.case" + never);
}

TEST_F(CommandLine, ABoundThatIsNoNumberIsCountedShrunkAndReplayedAlike) {
  const std::string subject = " --subject " + plugin("bound_nan");
  const json found = json_of(1, "fuzz --family uniform --cases 400 --db a.db" + subject);
  EXPECT_GT(found["subjects"]["always"]["vt"]["faults"]["error"], 50);
  const json finding = report_of("a.db", 1)["findings"][0];
  EXPECT_EQ(finding["what"], "fault");
  expect_code(0, "shrink report/" + finding["file"].get<std::string>() + " -o shrunk.case" + subject);
  EXPECT_THAT(read("shrunk.case"), StartsWith("# fault of always: "));
  EXPECT_EQ(json_of(1, "replay shrunk.case" + subject)["signatures"][0]["what"], "fault");
}

TEST_F(CommandLine, AMissGivesExitCodeOne) {
  EXPECT_THAT(expect_code(1, "replay hit.vt --subject " + plugin("never")).out,
              HasSubstr(": MISSED the collision\n"));
}

/// A subject, and the exit code of every subcommand that shows the subject's results.
struct Shown {
  const char* what;
  const char* subject;  ///< a plug-in with options, or a built-in subject
  int code;
  const char* fails_on = "";  ///< a value of --fail-on with which the exit code is 1
  const char* environment = "NEARMISS_ONE_IN=10";
  const char* options = "";
  bool only_replayed = false;
};

class ExitCodes : public CommandLine, public ::testing::WithParamInterface<Shown> {
 protected:
  /// Writes 43 queries to q.vt. Most of the misbehaving plug-ins misbehave at only one query in
  /// NEARMISS_ONE_IN.
  void SetUp() override {
    const std::string late = "0.95 0.01 1  0 0 0  1 0 0  0 1 0   0.95 0.01 -2  0 0 0  1 0 0  0 1 0\n";
    ASSERT_EQ(run("family uniform --kind vt --count 40").code, 0);
    write("q.vt", hit + miss + late + read("out.txt"));
  }

  /// Runs a command that stores its results in a.db, and all commands that show these results. Expects the
  /// exit code of GetParam() from each of these commands.
  void expect_codes(const std::string& command) const {
    const Shown& shown = GetParam();
    const std::string subject = std::string(shown.subject).find(".so") == std::string::npos
                                    ? shown.subject
                                    : NEARMISS_PLUGINS "/" + std::string(shown.subject);
    const std::string environment =
        std::string(shown.environment) + " NEARMISS_MARK=" + file("mark").string();
    const std::string trial = command + " -q --no-shrink --subject '" + subject + "' " + shown.options;
    const Output output = run(trial + " --db a.db", environment);
    EXPECT_EQ(output.code, shown.code) << trial << output.out << output.error;
    EXPECT_EQ(output.out.find("FAIL") == std::string::npos, shown.code == 0) << output.out;
    EXPECT_EQ(run("merge b.db a.db").code, shown.code) << trial;
    EXPECT_EQ(run("report b.db -o report --baseline a.db").code, shown.code) << trial;
    const auto report = report_of("b.db", shown.code);
    EXPECT_EQ(report["headline"]["clean"], shown.code == 0) << trial;
    EXPECT_EQ(report["headline"]["alarms"].empty(), shown.code == 0) << trial;
    for (const auto& each : report["verdicts"])
      EXPECT_TRUE(!each["clean"] || each["finding"].is_null()) << trial;
    if (*shown.fails_on != '\0') {
      const std::string option = std::string(" --fail-on ") + shown.fails_on;
      EXPECT_EQ(run(trial + option, environment).code, 1) << trial;
      EXPECT_EQ(run("merge c.db a.db" + option).code, 1) << trial;
      EXPECT_EQ(report_of("b.db" + option, 1)["headline"]["clean"], false) << trial;
    }
    for (const char* name : {"a.db", "b.db", "c.db", "mark"}) std::filesystem::remove(file(name));
  }
};

TEST_P(ExitCodes, AreThoseOfWhatIsShown) {
  expect_codes("replay q.vt");
  if (!GetParam().only_replayed) expect_codes("fuzz --cases 80 --family uniform");
}

INSTANTIATE_TEST_SUITE_P(
    All, ExitCodes,
    ::testing::Values(Shown{"clean", "wang", 0}, Shown{"miss", "never.so", 1},
                      Shown{"late", "promises.so", 1}, Shown{"refuted_bound", "bounded.so", 1},
                      Shown{"crash", "crash.so", 1}, Shown{"exit", "leave.so", 1},
                      Shown{"error", "fail.so", 1}, Shown{"exception", "throwing_else_reporting.so", 1},
                      Shown{"memory", "eat.so", 1, "", "NEARMISS_ONE_IN=10", "--query-memory 64M"},
                      Shown{"protocol", "intruding_write.so", 1}, Shown{"load", "leaves_later.so", 1},
                      Shown{"invalid", "invalid_time.so", 1},
                      Shown{"some_slow", "sleep.so", 0, "slow", "NEARMISS_ONE_IN=50", "--query-time 30ms"},
                      Shown{"most_slow", "sleep.so", 1, "", "NEARMISS_ONE_IN=2", "--query-time 30ms"},
                      Shown{"all_slow", "sleep.so", 1, "", "NEARMISS_ONE_IN=1", "--query-time 30ms"},
                      Shown{"unknown", "several.so:told:answer=2", 0, "unknown"},
                      Shown{"some_beyond_contract", "cautious.so", 0, "contract"},
                      Shown{"all_beyond_contract", "never_asked.so", 1},
                      Shown{"other_kind", "several.so:edges", 1, "", "NEARMISS_ONE_IN=10", "", true}),
    [](const auto& each) { return std::string(each.param.what); });

TEST_F(CommandLine, FailOnTakesNamesOfFailures) {
  expect_refused("replay hit.vt --fail-on unknown,speed --db new.db", {"--fail-on: found 'speed'", "slow"});
  for (const std::string always : {"miss", "crash"})
    expect_refused("replay hit.vt --fail-on " + always + " --db new.db",
                   {"found '" + always + "', which always gives exit code 1"});
}

TEST_F(CommandLine, AWrongRecordedTruthGivesExitCodeOne) {
  write("a.case",
        "# deliberately wrong\nkind vt\ntruth 0\nx0 0.25 0.25 1\nx1 0 0 0\nx2 1 0 0\nx3 0 1 0\n"
        "y0 0.25 0.25 -1\ny1 0 0 0\ny2 1 0 0\ny3 0 1 0\n");
  EXPECT_EQ(json_of(1, "replay a.case")["oracle"]["mismatches_with_recorded_truth"], 1);
}

}  // namespace
}  // namespace nearmiss
