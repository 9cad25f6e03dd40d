// Tests the command line as a user sees it: answers and exit codes.
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::CommandLine;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::StartsWith;

TEST_F(CommandLine, OraclePrintsOneLinePerQuery) {
  write("q.vt", "# two queries\n" + hit + "\n" + miss);
  EXPECT_EQ(run("oracle --kind vt q.vt").out, "1\n0\n");
  EXPECT_EQ(run("oracle --kind vt --method exact - < q.vt").out, "1\n0\n");
}

TEST_F(CommandLine, OracleAnswersByEveryMethod) {
  write("q.vt", hit + miss);
  // The vertex goes through the triangle and back. Parity cannot distinguish its two roots from none.
  write("even.vt", "-0.375 -0.3125 0.25  0 0 0  1 -1 0  1 0 1   1.125 0.4375 0.25  0 0 0  1 1 0  -1 0 1\n");
  for (const char* method : {"filtered", "exact", "certificate", "parity", "all"})
    EXPECT_EQ(run(std::string("oracle --kind vt q.vt --method ") + method).out, "1\n0\n") << method;
  EXPECT_EQ(run("oracle --kind vt even.vt --method all").out, "1\n");
  EXPECT_EQ(run("oracle --kind vt even.vt --method certificate").out, "1\n");
  EXPECT_EQ(run("oracle --kind vt even.vt --method parity").out, "0\n");
}

TEST_F(CommandLine, OracleSaysWhatAMethodDoesNotKnow) {
  // The triangle is an edge, which is exactly 1 below the vertex when 2 t² = 1, and never nearer.
  write("q.vt", "0 -.5 1  -1 0 0  1 0 0  -1 0 0   -1 -.5 1  -1 -1 0  1 1 0  -1 -1 0   1\n");
  EXPECT_EQ(run("oracle --kind vt q.vt").out, "1\n");
  const auto proof = run("oracle --kind vt q.vt --method certificate");
  EXPECT_EQ(proof.out, "-\n");
  EXPECT_EQ(proof.code, 1);
}

TEST_F(CommandLine, OracleSaysWhatReplacesAMethodThatIsGone) {
  write("q.vt", hit);
  expect_refused("oracle --kind vt q.vt --method sturm", {"'sturm' is gone", "--method certificate"});
}

TEST_F(CommandLine, OraclePrintsTimeAndDistance) {
  write("q.vt", hit + miss);
  EXPECT_EQ(run("oracle --kind vt --toi q.vt").out, "1 0x1p-1 0x1p-1\n0 inf inf\n");
  EXPECT_THAT(run("oracle --kind vt --distance q.vt").out,
              MatchesRegex("1 0x0p\\+0 0x0p\\+0\n0 0x[^ ]* 0x[^ ]*\n"));
  EXPECT_THAT(run("oracle --kind vt --toi --distance q.vt").out,
              StartsWith("1 0x1p-1 0x1p-1 0x0p+0 0x0p+0\n0 inf inf 0x"));
}

TEST_F(CommandLine, VerdictPrintsStageAndTime) {
  write("q.vt", hit + miss);
  EXPECT_EQ(run("verdict --kind vt --subject wang q.vt").out, "1 proximity 0x1p-1\n0\n");
  EXPECT_EQ(run("verdict --kind vt --subject " + plugin("example") + " q.vt").out, "1 unspecified nan\n0\n");
}

TEST_F(CommandLine, TheBoundCanBeGiven) {
  write("q.vt", hit);
  EXPECT_EQ(run("verdict --kind vt --bound 8 q.vt").code, 0);
  expect_refused("verdict --kind vt --bound 0.5 q.vt",
                 {"the given bound B = 0.5", "is smaller than a pair's own"});
  expect_refused("verdict --kind vt --bound=-1 q.vt", {"--bound: found '-1', expected a positive number"});
}

TEST_F(CommandLine, ReplayComparesAndCounts) {
  write("q.vt", hit + miss);
  expect_code(0, "replay q.vt --subject basic,wang --json new.json");
  const json counts = read_json("new.json")["subjects"]["wang"]["vt"];
  EXPECT_EQ(counts["queries"], 2);
  EXPECT_EQ(counts["collisions"], 1);
  EXPECT_EQ(counts["positives"], 1);
  EXPECT_EQ(counts["false_negatives"], 0);
}

TEST_F(CommandLine, ACampaignCountsAPluginsCrashesAndHangsAndContinues) {
  std::string again;
  for (const std::string way : {"crash", "hang"}) {
    const int code = way == "hang" ? 0 : 1;
    const Output output =
        expect_code(code, "fuzz --family planted --cases 1000 --query-time 20ms --json new.json --db " + way +
                              ".db --subject " + plugin(way));
    EXPECT_THAT(output.out, HasSubstr(way == "hang" ? "SLOW in " : "NO ANSWER ("));
    const json counts = read_json("new.json")["subjects"]["misbehaving"]["ee"];
    EXPECT_EQ(counts["queries"], 500);
    const int faults = counts["faults"][way == "hang" ? "time" : way];
    EXPECT_GT(faults, 0);
    EXPECT_EQ(counts["positives"].get<int>() + faults, 500);
    const json finding = report_of(way + ".db", code)["findings"][0];
    EXPECT_EQ(finding["what"], "fault");
    again = finding["again"];
  }
  // The command in the report, run in the report's folder, makes a stored query fail again.
  EXPECT_THAT(again, ::testing::MatchesRegex("nearmiss replay cases/fault-misbehaving-001.case --subject "
                                             "/.*hang.so --query-time 20ms --query-memory [0-9]+"));
  expect_code(1, again.substr(9), "cd report &&");
  expect_code(0,
              "shrink report/cases/fault-misbehaving-001.case --query-time 20ms --subject " + plugin("hang"));
}

TEST_F(CommandLine, FuzzMergeAndReport) {
  EXPECT_EQ(run("fuzz --cases 1100 --seed 5 --shard 0/2 --db a.db").code, 0);
  EXPECT_EQ(run("fuzz --cases 1100 --seed 5 --shard 1/2 --db b.db --json b.json").code, 0);
  EXPECT_EQ(run("merge all.db a.db b.db").code, 0);
  const json report = report_of("all.db --baseline a.db");
  int queries = 0;
  for (const char* kind : {"vt", "ee", "vv", "ve"})
    queries += report["subjects"]["wang"][kind]["queries"].get<int>();
  EXPECT_EQ(queries, 1100);
  ASSERT_EQ(report["runs"].size(), 1);
  EXPECT_FALSE(report["runs"][0].contains("missing"));
  EXPECT_TRUE(report["baseline"]["new_signatures"].empty());
}

TEST_F(CommandLine, AReportHasSeveralStoresAsItsBaseline) {
  for (const char* seed : {"1", "2", "3"})
    EXPECT_EQ(run(std::string("fuzz --cases 1100 --seed ") + seed + " --db " + seed + ".db").code, 0);
  const json baseline = report_of("--baseline 1.db --baseline 2.db 3.db")["baseline"];
  ASSERT_EQ(baseline["runs"].size(), 2);
  for (const json& subject : baseline["subjects"])
    EXPECT_EQ(subject["before"]["queries"], 2 * subject["now"]["queries"].get<int>());
  expect_refused("report 3.db --baseline 1.db --baseline 1.db -o report", {"run with seed 1 twice"});
}

TEST_F(CommandLine, FuzzSweepsParameters) {
  const Output output = expect_code(
      0,
      "fuzz --sweep needle,end-contact --steps 3 --cases 600 --subject wang,exact --db a.db --json new.json");
  for (const char* title : {"wang along needle@x", "exact along needle@x", "wang along end-contact@x"})
    EXPECT_THAT(output.out, HasSubstr(title));
  const json steps = read_json("new.json")["sweeps"]["needle"]["wang"];
  ASSERT_EQ(steps.size(), 3);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(steps[i]["value"], (std::array{-16, -8, 0})[i]);
    EXPECT_EQ(steps[i]["queries"], 100);
  }
  EXPECT_EQ(report_of("a.db")["sweeps"]["end-contact"]["exact"].size(), 3);
}

TEST_F(CommandLine, FuzzSweepsAllFamiliesOfTheKindsThatASubjectDecides) {
  const auto swept = [&](const std::string& options) {
    EXPECT_EQ(run("fuzz --steps 2 --cases 2000 --no-shrink --json new.json " + options).code, 0);
    std::set<std::string> names;
    const json sweeps = read_json("new.json")["sweeps"];
    for (const auto& [name, ignored] : sweeps.items()) names.insert(name);
    return names;
  };
  const auto of_wang = swept("--sweep all --subject wang");
  EXPECT_THAT(of_wang, ::testing::IsSupersetOf({"stiff", "needle", "v-drifting", "v-stiff~drawn"}));
  EXPECT_THAT(of_wang, ::testing::Not(::testing::Contains("uniform")));  // it has no parameter
  const auto of_vertices = swept("--sweep vertices --subject wang");
  EXPECT_THAT(of_vertices, ::testing::Each(::testing::StartsWith("v-")));
  EXPECT_THAT(of_wang, ::testing::IsSupersetOf(of_vertices));
  EXPECT_THAT(swept("--sweep all --subject wang-plain"), ::testing::IsSupersetOf(of_vertices));
  EXPECT_THAT(swept("--sweep all --subject exact"),
              ::testing::Not(::testing::Contains(::testing::StartsWith("v-"))));
}

TEST_F(CommandLine, FuzzTakesPairsOfAMesh) {
  write_falling_triangle();
  const std::string mesh = "--mesh start.obj end.obj --json new.json ";
  EXPECT_EQ(run("fuzz --cases 400 --family mesh " + mesh).code, 0);
  EXPECT_EQ(read_json("new.json")["subjects"]["wang"]["ee"]["families"]["mesh"]["queries"], 200);
  EXPECT_EQ(run("fuzz --cases 400 --sweep mesh --steps 2 " + mesh).code, 0);
  EXPECT_EQ(read_json("new.json")["sweeps"]["mesh"]["wang"].size(), 2);
  EXPECT_EQ(run("fuzz --cases 500 " + mesh).code, 0);
  EXPECT_GT(read_json("new.json")["subjects"]["wang"]["vt"]["families"]["mesh"]["queries"], 0);
}

TEST_F(CommandLine, SceneComparesAllPairs) {
  write_falling_triangle("0.5 1");
  const std::string scene = "scene start.obj end.obj --json scene.json ";
  expect_code(0, scene + "--leave-out boxes --bound pair,scene,100 --export pairs");
  const json subjects = read_json("scene.json")["subjects"];
  EXPECT_EQ(subjects.size(), 4);  // basic has no bound
  for (const char* name : {"basic", "wang", "wang@100"})
    EXPECT_EQ(subjects[name]["vt"]["collisions"], 3) << name;
  EXPECT_TRUE(std::filesystem::exists(file("pairs.vt")));
  expect_refused("scene start.obj end.obj --export pairs", {"pairs.vt: exists already"});
  // The exported pairs give the same counts.
  EXPECT_EQ(run("replay pairs.vt pairs.ee --subject wang --json replay.json").code, 0);
  for (const char* kind : {"vt", "ee"})
    for (const char* count : {"queries", "collisions", "positives", "false_positives"})
      EXPECT_EQ(read_json("replay.json")["subjects"]["wang"][kind][count], subjects["wang"][kind][count]);
  // Both triangles are only translated, so the plan needs no subject.
  const Output planned = expect_code(0, scene + "--verify-plan");
  EXPECT_THAT(planned.out, HasSubstr("plan verified: "));
  const json funnel = read_json("scene.json")["scenes"]["scene:start"]["vt"];
  EXPECT_EQ(funnel["asked"], 0);
  EXPECT_EQ(funnel["touching"], 3);
}

TEST_F(CommandLine, ScenesAreBuiltInToo) {
  const Output list = expect_code(0, "scene --list");
  EXPECT_THAT(list.out, HasSubstr("\nknot "));
  const Output output = expect_code(0, "scene flying@300 --subject wang --json new.json");
  EXPECT_THAT(output.out, HasSubstr("flying@300: 21 frames, "));
  const json scenes = read_json("new.json")["scenes"];
  EXPECT_EQ(scenes.size(), 20);
  EXPECT_TRUE(scenes.contains("scene:flying@300#19"));
  std::filesystem::remove(file("new.json"));
  expect_refused("scene flying@9", {"flying@9: found size 9, expected 100 to 4000000"});
  expect_refused("scene flyings", {"flyings: found neither a folder nor a scene", "nearmiss scene --list"});
  expect_refused("scene", {"SCENE is required"});
  // A path to a folder is not taken for the built-in scene of that name.
  write("flying/1.obj", two_triangles("1"));
  write("flying/2.obj", two_triangles("-1"));
  EXPECT_THAT(run("scene ./flying").out, HasSubstr("flying: 2 frames, 6 vertices"));
}

TEST_F(CommandLine, FuzzSearchesAgainstItsSubjects) {
  EXPECT_EQ(run("fuzz --cases 104 --family uniform --search --subject defect:vv --json new.json").code, 1);
  int misses = 0;
  for (const char* kind : {"vt", "ee"}) {
    const json families = read_json("new.json")["subjects"]["defect:vv"][kind]["families"];
    EXPECT_EQ(families["search-miss-defect:vv"]["queries"], 2);
    misses += families["search-miss-defect:vv"]["false_negatives"].get<int>();
  }
  EXPECT_GT(misses, 0);
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
  EXPECT_EQ(run("replay shrunk.case" + never).code, 1);
  EXPECT_EQ(run("shrink shrunk.case" + never).code, 0);
}

TEST_F(CommandLine, ABoundThatIsNoNumberIsCountedShrunkAndReplayedAlike) {
  const std::string subject = " --subject " + plugin("bound_nan");
  EXPECT_EQ(run("fuzz --family uniform --cases 400 --db a.db --json new.json" + subject).code, 1);
  EXPECT_GT(read_json("new.json")["subjects"]["always"]["vt"]["faults"]["error"], 50);
  const json finding = report_of("a.db", 1)["findings"][0];
  EXPECT_EQ(finding["what"], "fault");
  const std::string found = "report/" + finding["file"].get<std::string>();
  const Output shrunk = expect_code(0, "shrink " + found + " -o shrunk.case" + subject);
  EXPECT_THAT(read("shrunk.case"), StartsWith("# fault of always: "));
  EXPECT_EQ(run("replay shrunk.case --json new.json" + subject).code, 1);
  EXPECT_EQ(read_json("new.json")["signatures"][0]["what"], "fault");
}

TEST_F(CommandLine, ShrinkKeepsAReportBeyondItsBound) {
  write("q.ee", "0 0 1  1 0 1.1  0.5 -1 0  0.5 1 0.2   0 0 3  1 0 3.3  0.5 -1 0.1  0.5 1 0\n");
  expect_code(0, "shrink q.ee -o shrunk.case --subject " + plugin("bounded"));
  EXPECT_THAT(read("shrunk.case"), StartsWith("# refuted-bound of always: ee unspecified\n"));
  EXPECT_EQ(run("replay shrunk.case --json new.json --subject " + plugin("bounded")).code, 1);
  EXPECT_EQ(read_json("new.json")["signatures"][0]["what"], "refuted-bound");
}

TEST_F(CommandLine, BenchWritesItsResults) {
  write("own.vt", hit);
  expect_code(0, "bench own.vt --queries 50 --runs 3 --json new.json");
  const json results = read_json("new.json")["results"];
  EXPECT_EQ(results.size(), 2 * 1 + 2 * 2 * 3);  // 2 subjects: 1 kind of own.vt, 2 kinds of 3 random inputs
  for (const json& each : results) {
    EXPECT_GT(each["ns_per_query"], 0);
    EXPECT_EQ(each["runs"], 3);
  }
  EXPECT_EQ(results[0]["input"], "own.vt");
}

TEST_F(CommandLine, BenchSaysThatASubjectGivesNoAnswer) {
  const Output output =
      expect_code(1, "bench --queries 1 --runs 1 --json new.json --subject basic," + plugin("crash"),
                  "NEARMISS_ONE_IN=1");
  EXPECT_THAT(output.out, MatchesRegex(".*misbehaving +no answer +no answer\n.*"));
  const json results = read_json("new.json")["results"];
  EXPECT_GT(results[0]["ns_per_query"], 0);
  EXPECT_EQ(results[1]["ns_per_query"], nullptr);
  EXPECT_EQ(results[1]["ratio"], nullptr);
}

TEST_F(CommandLine, EverySubcommandHasHelp) {
  std::istringstream help(run("--help").out);
  std::vector<std::string> names;
  bool is_listed = false;
  for (std::string line; std::getline(help, line);) {
    if (is_listed && line.empty()) break;
    if (is_listed) names.push_back(line.substr(2, line.find(' ', 2) - 2));
    if (line == "Subcommands:") is_listed = true;
  }
  EXPECT_THAT(names, ::testing::IsSupersetOf({"fuzz", "audit", "ladder", "subjects"}));
  for (const std::string& name : names) {
    const Output output = run(name + " --help");
    EXPECT_EQ(output.code, 0) << name;
    EXPECT_THAT(output.out, HasSubstr("Usage: nearmiss " + name)) << name;
  }
}

}  // namespace
}  // namespace nearmiss
