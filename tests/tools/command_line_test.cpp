// The command line from outside: answers, exit codes, and what it says to bad input.
#include "tests/tools/command_line.hpp"

#include <algorithm>

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::CommandLine;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::StartsWith;

/// A vertex that falls through the triangle (0,0,0) (1,0,0) (0,1,0), from z = 1 to -1, and one that stays
/// above.
const std::string hit = "0.25 0.25 1  0 0 0  1 0 0  0 1 0   0.25 0.25 -1  0 0 0  1 0 0  0 1 0\n";
const std::string miss = "0.25 0.25 2  0 0 0  1 0 0  0 1 0   0.25 0.25 0x1p0  0 0 0  1 0 0  0 1 0\n";

std::string plugin(const std::string& name) { return NEARMISS_PLUGINS "/" + name + ".so"; }

// --- answers ----------------------------------------------------------------------------------------------

TEST_F(CommandLine, OraclePrintsALineAQuery) {
  write("q.vt", "# two queries\n" + hit + "\n" + miss);
  EXPECT_EQ(run("oracle --kind vt q.vt").out, "1\n0\n");
  EXPECT_EQ(run("oracle --kind vt --method exact - < q.vt").out, "1\n0\n");
}

TEST_F(CommandLine, OracleAnswersInThreeWays) {
  write("q.vt", hit + miss);
  // Through the triangle and back: two roots, which parity cannot see.
  write("even.vt", "-0.375 -0.3125 0.25  0 0 0  1 -1 0  1 0 1   1.125 0.4375 0.25  0 0 0  1 1 0  -1 0 1\n");
  for (const char* method : {"exact", "sturm", "parity", "all"})
    EXPECT_EQ(run(std::string("oracle --kind vt q.vt --method ") + method).out, "1\n0\n") << method;
  EXPECT_EQ(run("oracle --kind vt even.vt --method all").out, "1\n");
  EXPECT_EQ(run("oracle --kind vt even.vt --method sturm").out, "1\n");
  EXPECT_EQ(run("oracle --kind vt even.vt --method parity").out, "0\n");
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
  const Answer answer = run("replay q.vt --subject basic,wang --json new.json");
  EXPECT_EQ(answer.code, 0) << answer.error;
  const json counts = read_json("new.json")["subjects"]["wang"]["vt"];
  EXPECT_EQ(counts["queries"], 2);
  EXPECT_EQ(counts["collisions"], 1);
  EXPECT_EQ(counts["positives"], 1);
  EXPECT_EQ(counts["false_negatives"], 0);
}

TEST_F(CommandLine, AMissExitsWithOne) {
  write("q.vt", hit);
  const Answer answer = run("replay q.vt --subject " + plugin("never"));
  EXPECT_EQ(answer.code, 1);
  EXPECT_THAT(answer.out, HasSubstr("MISSED 1 of 1 collision"));
  EXPECT_THAT(answer.out, HasSubstr("q.vt:1"));
}

TEST_F(CommandLine, APluginThatCrashesAndHangsIsCountedAndTheCampaignGoesOn) {
  for (const std::string way : {"crash", "hang"}) {
    const Answer answer = run("fuzz --family planted --cases 1000 --query-time 20ms --json new.json --db " +
                              way + ".db --subject " + plugin(way));
    EXPECT_EQ(answer.code, 1) << answer.error;
    EXPECT_THAT(answer.out, HasSubstr("NO ANSWER to "));
    const json counts = read_json("new.json")["subjects"]["misbehaving"]["ee"];
    EXPECT_EQ(counts["queries"], 500);
    const int faults = counts["faults"][way == "hang" ? "time" : way];
    EXPECT_GT(faults, 0);
    EXPECT_EQ(counts["positives"].get<int>() + faults, 500);
    EXPECT_EQ(run("report " + way + ".db -o report").code, 0);
    EXPECT_EQ(read_json("report/report.json")["findings"][0]["what"], "fault");
  }
  std::filesystem::remove(file("new.json"));
  // A stored query fails again, by the command in the report, which works in the report's folder.
  const std::string again = read_json("report/report.json")["findings"][0]["again"];
  EXPECT_THAT(again, ::testing::MatchesRegex("nearmiss replay cases/fault-misbehaving-001.case --subject "
                                             "/.*hang.so --query-time 20ms --query-memory [0-9]+"));
  EXPECT_EQ(run(again.substr(9), "cd report &&").code, 1);
  EXPECT_EQ(
      run("shrink report/cases/fault-misbehaving-001.case --query-time 20ms --subject " + plugin("hang"))
          .code,
      0);
}

TEST_F(CommandLine, AWrongRecordedTruthExitsWithOne) {
  write("a.case",
        "# deliberately wrong\nkind vt\ntruth 0\nx0 0.25 0.25 1\nx1 0 0 0\nx2 1 0 0\nx3 0 1 0\n"
        "y0 0.25 0.25 -1\ny1 0 0 0\ny2 1 0 0\ny3 0 1 0\n");
  const Answer answer = run("replay a.case --json new.json");
  EXPECT_EQ(answer.code, 1);
  EXPECT_EQ(read_json("new.json")["oracle"]["mismatches_with_recorded_truth"], 1);
}

TEST_F(CommandLine, FuzzMergeAndReport) {
  EXPECT_EQ(run("fuzz --cases 1100 --seed 5 --shard 0/2 --db a.db").code, 0);
  EXPECT_EQ(run("fuzz --cases 1100 --seed 5 --shard 1/2 --db b.db --json b.json").code, 0);
  EXPECT_EQ(run("merge all.db a.db b.db").code, 0);
  EXPECT_EQ(run("report all.db -o report --baseline a.db").code, 0);
  const json report = read_json("report/report.json");
  int queries = 0;
  for (const char* kind : {"vt", "ee"}) queries += report["subjects"]["wang"][kind]["queries"].get<int>();
  EXPECT_EQ(queries, 1100);
  ASSERT_EQ(report["runs"].size(), 1);
  EXPECT_FALSE(report["runs"][0].contains("missing"));
  EXPECT_TRUE(report["baseline"]["new_signatures"].empty());
}

TEST_F(CommandLine, FuzzSweepsParameters) {
  const Answer answer = run(
      "fuzz --sweep needle,end-contact --steps 3 --cases 600 --subject wang,exact --db a.db --json new.json");
  EXPECT_EQ(answer.code, 0) << answer.error;
  for (const char* title : {"wang along needle@x", "exact along needle@x", "wang along end-contact@x"})
    EXPECT_THAT(answer.out, HasSubstr(title));
  const json steps = read_json("new.json")["sweeps"]["needle"]["wang"];
  ASSERT_EQ(steps.size(), 3);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(steps[i]["value"], (std::array{-16, -8, 0})[i]);
    EXPECT_EQ(steps[i]["queries"], 100);
  }
  EXPECT_EQ(run("report a.db -o report").code, 0);
  EXPECT_EQ(read_json("report/report.json")["sweeps"]["end-contact"]["exact"].size(), 3);
}

const std::string falling_triangle =
    "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0.5 0.5 1\nv 1 0.5 1\nv 0.5 9 1\nf 1 2 3\nf 4 5 6\n";
const std::string fallen_triangle =
    "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0.5 0.5 -1\nv 1 0.5 -1\nv 0.5 9 -1\nf 1 2 3\nf 4 5 6\n";

TEST_F(CommandLine, FuzzTakesPairsOfAMesh) {
  write("start.obj", falling_triangle);
  write("end.obj", fallen_triangle);
  const std::string mesh = "--mesh start.obj end.obj --json new.json ";
  EXPECT_EQ(run("fuzz --cases 400 --family mesh " + mesh).code, 0);
  EXPECT_EQ(read_json("new.json")["subjects"]["wang"]["ee"]["families"]["mesh"]["queries"], 200);
  EXPECT_EQ(run("fuzz --cases 400 --sweep mesh --steps 2 " + mesh).code, 0);
  EXPECT_EQ(read_json("new.json")["sweeps"]["mesh"]["wang"].size(), 2);
  EXPECT_EQ(run("fuzz --cases 500 " + mesh).code, 0);
  EXPECT_EQ(read_json("new.json")["subjects"]["wang"]["vt"]["families"]["mesh"]["queries"], 10);
}

TEST_F(CommandLine, SceneComparesAllPairs) {
  write("start.obj", "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0.5 0.5 1\nv 1 0.5 1\nv 0.5 1 1\nf 1 2 3\nf 4 5 6\n");
  write("end.obj", "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0.5 0.5 -1\nv 1 0.5 -1\nv 0.5 1 -1\nf 1 2 3\nf 4 5 6\n");
  const std::string scene = "scene start.obj end.obj --json scene.json ";
  const Answer answer = run(scene + "--leave-out boxes --bound pair,scene,100 --export pairs");
  EXPECT_EQ(answer.code, 0) << answer.error;
  const json subjects = read_json("scene.json")["subjects"];
  EXPECT_EQ(subjects.size(), 4);  // basic knows no bound
  for (const char* name : {"basic", "wang", "wang@100"})
    EXPECT_EQ(subjects[name]["vt"]["collisions"], 3) << name;
  EXPECT_TRUE(std::filesystem::exists(file("pairs.vt")));
  expect_refused("scene start.obj end.obj --export pairs", {"pairs.vt: exists already"});
  // The exported pairs give the same counts.
  EXPECT_EQ(run("replay pairs.vt pairs.ee --subject wang --json replay.json").code, 0);
  for (const char* kind : {"vt", "ee"})
    for (const char* count : {"queries", "collisions", "positives", "false_positives"})
      EXPECT_EQ(read_json("replay.json")["subjects"]["wang"][kind][count], subjects["wang"][kind][count]);
  // Both triangles only translate, so that the plan needs no subject.
  const Answer planned = run(scene + "--verify-plan");
  EXPECT_EQ(planned.code, 0) << planned.error;
  EXPECT_THAT(planned.out, HasSubstr("plan verified: "));
  const json funnel = read_json("scene.json")["scenes"]["scene:start"]["vt"];
  EXPECT_EQ(funnel["asked"], 0);
  EXPECT_EQ(funnel["touching"], 3);
}

TEST_F(CommandLine, ScenesAreBuiltInToo) {
  const Answer list = run("scene --list");
  EXPECT_EQ(list.code, 0) << list.error;
  EXPECT_THAT(list.out, HasSubstr("\nknot "));
  const Answer answer = run("scene flying@300 --subject wang --json new.json");
  EXPECT_EQ(answer.code, 0) << answer.error;
  EXPECT_THAT(answer.out, HasSubstr("flying@300: 21 frames, "));
  const json scenes = read_json("new.json")["scenes"];
  EXPECT_EQ(scenes.size(), 20);
  EXPECT_TRUE(scenes.contains("scene:flying@300#19"));
  std::filesystem::remove(file("new.json"));
  expect_refused("scene flying@9", {"flying@9: found size 9, expected 100 to 4000000"});
  expect_refused("scene flyings", {"flyings: found neither a folder nor a scene", "nearmiss scene --list"});
  expect_refused("scene", {"SCENE is required"});
  // A folder of that name is another one.
  write("flying/1.obj", falling_triangle);
  write("flying/2.obj", fallen_triangle);
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

TEST_F(CommandLine, PowerGoesOnWhereItStopped) {
  const std::string command = "power --time 1ms --way families,search --json new.json --subject ";
  const Answer answer = run(command + "defect:vertex-edge");
  EXPECT_EQ(answer.code, 0) << answer.error;
  EXPECT_THAT(answer.out, HasSubstr("found, of 1"));
  EXPECT_EQ(run(command + "defect:vertex-edge,defect:mu*1").code, 0);
  const json results = read_json("new.json");
  ASSERT_EQ(results.size(), 4);
  EXPECT_EQ(results[0]["failure"], "false-negative");
  EXPECT_GT(results[0]["cases"], 0);
  EXPECT_EQ(results[2]["subject"], "defect:mu*1");
  EXPECT_TRUE(results[2]["failure"].is_null());
}

TEST_F(CommandLine, TightnessGoesIntoTheReport) {
  expect_refused("tightness --tolerance nu", {"'nu'"});
  const Answer answer = run("tightness --time 1ms --tolerance D2,vertex-edge --db new.db --json new.json");
  EXPECT_EQ(answer.code, 0) << answer.error;
  EXPECT_THAT(answer.out, HasSubstr("D2"));
  EXPECT_LT(read_json("new.json")["tightness"]["D2"]["value"], 1);
  EXPECT_EQ(run("report new.db -o report").code, 0);
  EXPECT_GT(read_json("report/report.json")["tightness"]["vertex-edge"]["queries"], 0);
}

TEST_F(CommandLine, ShrinkWritesACaseThatFailsInTheSameWay) {
  write("q.vt", "0.3 0.37 1.1  0.1 0 0  1.7 0 0.2  0 1.3 0   0.31 0.2 -1.9  0 0.01 0  1.1 0 0.3  0 1.2 0\n");
  const std::string never = " --subject " + plugin("never");
  const Answer answer = run("shrink q.vt" + never);
  EXPECT_EQ(answer.code, 0) << answer.error;
  EXPECT_THAT(answer.out, StartsWith("# false-negative of always: vt simple-root inside in-face\n"
                                     "# distinct numbers: 11 -> "));
  EXPECT_THAT(answer.out, HasSubstr("kind vt\ntruth 1\nprovenance shrunk from q.vt:1\nx0 "));
  const Answer silent = run("shrink q.vt -o shrunk.case" + never);
  EXPECT_THAT(silent.out,
              MatchesRegex("distinct numbers: 11 -> [12]; their significant bits: 578 -> [1-4]\n"));
  EXPECT_EQ(read("shrunk.case"), answer.out);
  EXPECT_EQ(run("replay shrunk.case" + never).code, 1);
  EXPECT_EQ(run("shrink shrunk.case" + never).code, 0);
}

TEST_F(CommandLine, ShrinkKeepsAReportBeyondItsBound) {
  write("q.ee", "0 0 1  1 0 1.1  0.5 -1 0  0.5 1 0.2   0 0 3  1 0 3.3  0.5 -1 0.1  0.5 1 0\n");
  const Answer answer = run("shrink q.ee -o shrunk.case --subject " + plugin("bounded"));
  EXPECT_EQ(answer.code, 0) << answer.error;
  EXPECT_THAT(read("shrunk.case"), StartsWith("# refuted-bound of always: ee unspecified\n"));
  EXPECT_EQ(run("replay shrunk.case --json new.json --subject " + plugin("bounded")).code, 1);
  EXPECT_EQ(read_json("new.json")["signatures"][0]["what"], "refuted-bound");
}

TEST_F(CommandLine, BenchWritesItsResults) {
  write("own.vt", hit);
  const Answer answer = run("bench own.vt --queries 50 --runs 3 --json new.json");
  EXPECT_EQ(answer.code, 0) << answer.error;
  const json results = read_json("new.json")["results"];
  EXPECT_EQ(results.size(), 2 * 1 + 2 * 2 * 3);  // two subjects: one kind of own.vt, two of each random input
  for (const json& each : results) {
    EXPECT_GT(each["ns_per_query"], 0);
    EXPECT_EQ(each["runs"], 3);
  }
  EXPECT_EQ(results[0]["input"], "own.vt");
}

TEST_F(CommandLine, SubjectsAreListed) {
  const Answer answer = run("subjects");
  for (const char* name :
       {"basic ", "basic-plain ", "wang ", "wang-eps ", "wang-plain ", "exact ", "defect:vv "})
    EXPECT_THAT(answer.out, HasSubstr(name));
}

TEST_F(CommandLine, EverySubcommandHasHelp) {
  for (const char* name : {"oracle", "verdict", "replay", "fuzz", "shrink", "scene", "merge", "report",
                           "power", "tightness", "bench", "subjects"}) {
    const Answer answer = run(std::string(name) + " --help");
    EXPECT_EQ(answer.code, 0) << name;
    EXPECT_THAT(answer.out, HasSubstr("Usage: nearmiss ")) << name;
  }
}

// --- bad input --------------------------------------------------------------------------------------------

TEST_F(CommandLine, BadQueries) {
  const std::string numbers = hit.substr(hit.find(' '));
  write("nan.vt", "# a comment\nnan" + numbers);
  write("inf.vt", hit + "inf" + numbers);
  write("word.vt", "x" + numbers);
  write("few.vt", "1 2 3\n");
  write("many.vt", hit.substr(0, hit.size() - 1) + " 5\n");
  write("empty.vt", "");
  write("comments.vt", "# nothing\n");
  for (const char* command :
       {"oracle --kind vt ", "verdict --kind vt ", "replay --json new.json --db new.db "}) {
    expect_refused(command + std::string("nan.vt"), {"nan.vt:2", "'nan'"});
    expect_refused(command + std::string("inf.vt"), {"inf.vt:2", "'inf'"});
    expect_refused(command + std::string("word.vt"), {"word.vt:1", "'x'"});
    expect_refused(command + std::string("few.vt"), {"few.vt:1", "3", "24"});
    expect_refused(command + std::string("many.vt"), {"many.vt:1", "24"});
    expect_refused(command + std::string("empty.vt"), {"empty.vt"});
    expect_refused(command + std::string("comments.vt"), {"comments.vt:1"});
    expect_refused(command + std::string("absent.vt"), {"absent.vt: cannot be read"});
  }
}

TEST_F(CommandLine, BadShrinks) {
  write("hit.vt", hit);
  write("two.vt", hit + miss);
  write("nan.vt", "nan" + hit.substr(hit.find(' ')));
  const std::string never = " --subject " + plugin("never");
  expect_refused("shrink hit.vt -o new", {"hit.vt:1", "wang does not fail", "expected a missed collision"});
  expect_refused("shrink two.vt -o new" + never, {"two.vt: found 2 queries, expected one"});
  expect_refused("shrink nan.vt -o new" + never, {"nan.vt:1", "'nan'"});
  expect_refused("shrink absent.case -o new" + never, {"absent.case: cannot be read"});
  expect_refused("shrink hit.vt -o new --subject wong", {"unknown subject 'wong'"});
  expect_refused("verdict --kind vt hit.vt --subject " + plugin("error"), {"always: no answer: vt error -7"});
  expect_refused("shrink hit.vt -o no/folder/new.case" + never, {"no/folder/new.case: cannot be written"});
  expect_refused("shrink", {"CASE"});
}

TEST_F(CommandLine, BadNames) {
  write("q.vt", hit);
  expect_refused("replay q.vt --subject wong --db new.db", {"unknown subject 'wong'", "wang", "exact"});
  expect_refused("replay q.vt --subject wang,wang --db new.db", {"two subjects named 'wang'"});
  expect_refused("fuzz --cases 10 --family plantet --db new.db", {"unknown family 'plantet'", "planted"});
  expect_refused("fuzz --cases 10 --family planted,all --db new.db", {"the family 'planted' twice"});
  expect_refused("fuzz --cases 10 --family aspect@17 --db new.db", {"'aspect@17'", "from 0 to 16"});
  expect_refused("fuzz --cases 10 --family mesh --db new.db", {"unknown family 'mesh'"});
  expect_refused("fuzz --cases 10 --sweep aspekt --db new.db", {"unknown family 'aspekt'", "aspect"});
  expect_refused("fuzz --cases 10 --sweep uniform --db new.db", {"'uniform'", "with a parameter"});
  expect_refused("fuzz --cases 10 --sweep aspect,aspect --db new.db", {"'aspect@0' twice in --sweep"});
  expect_refused("verdict --kind vt --subject wong q.vt", {"unknown subject 'wong'"});
  expect_refused("oracle --kind vf q.vt", {"--kind", "vf"});
}

TEST_F(CommandLine, BadUsage) {
  write("q.vt", hit);
  expect_refused("", {"subcommand"});
  expect_refused("fuzz --db new.db", {"--cases", "--time"});
  expect_refused("fuzz --cases 0 --db new.db", {"--cases"});
  expect_refused("fuzz --cases 10 --sweep aspect --steps 1 --db new.db", {"--steps"});
  expect_refused("fuzz --cases 10 --steps 3 --db new.db", {"--steps", "--sweep"});
  expect_refused("fuzz --cases 10 --sweep aspect --family aspect --db new.db", {"--sweep", "--family"});
  expect_refused("fuzz --cases 10 --mesh a.obj --db new.db", {"--mesh"});
  expect_refused("fuzz --time 3parsec --db new.db", {"--time: found '3parsec'", "30s"});
  expect_refused("fuzz --cases 10 --shard 2/2 --db new.db", {"--shard: found '2/2'"});
  expect_refused("replay q.vt --json no/folder/new.json", {"no/folder"});
  expect_refused("replay q.vt --db no/folder/new.db", {"no/folder/new.db"});
  expect_refused("replay", {"PATH"});
}

TEST_F(CommandLine, BadPlugins) {
  write("q.vt", hit);
  const auto refused = [&](const std::string& name, const std::vector<std::string>& words) {
    expect_refused("replay q.vt --db new.db --json new.json --subject " + plugin(name), words);
  };
  refused("no_function", {"no_function.so", "nearmiss_get_subject"});
  refused("other_abi", {"other_abi.so", "abi 99", "expected 1"});
  refused("absent", {"absent.so", "cannot load"});
}

TEST_F(CommandLine, BadMeshes) {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  write("good.obj", square + "f 1 2 3\n");
  write("other.obj", square + "f 1 2 4\n");
  write("five.obj", square + "v 0 0 0\nf 1 2 3\n");
  write("far.obj", square + "f 1 2 9\n");
  write("nan.obj", "v 0 nan 0\n" + square + "f 1 2 3\n");
  write("empty.obj", "");
  const auto refused = [&](const std::string& end, const std::vector<std::string>& words) {
    expect_refused("scene good.obj " + end + " --db new.db --json new.json", words);
  };
  refused("other.obj", {"other.obj", "1 2 4", "1 2 3"});
  refused("five.obj", {"five.obj", "5 vertices", "4"});
  refused("far.obj", {"far.obj:5", "vertex 9"});
  refused("nan.obj", {"nan.obj:1", "'nan'"});
  refused("empty.obj", {"empty.obj"});
  refused("absent.obj", {"absent.obj: cannot be read"});
  expect_refused("fuzz --cases 10 --mesh good.obj five.obj --db new.db", {"five.obj", "5 vertices"});
  expect_refused("fuzz --cases 10 --mesh good.obj good.obj --db new.db", {"no ee pair in the mesh"});
}

TEST_F(CommandLine, TheLadderIsACampaign) {
  const std::string ladder = "ladder --scalar float,p60 --family uniform --cases 80 --db ladder.db";
  EXPECT_EQ(run(ladder).code, 0);
  EXPECT_THAT(run(ladder + " --resume").out, HasSubstr("wang-tight:p60"));
  EXPECT_THAT(run("report ladder.db -o ladder").out, HasSubstr("wang:float"));
  EXPECT_THAT(run("ladder --scalar p15 --cases 1").error, HasSubstr("p16 to p256"));
}

TEST_F(CommandLine, TheAuditNamesWhatIsTooSmall) {
  const Answer answer = run("audit --queries 2 --steps 0 --json audit.json");
  EXPECT_EQ(answer.code, 0);
  EXPECT_THAT(answer.out, HasSubstr("TOO SMALL"));
  EXPECT_THAT(answer.out, HasSubstr("33492"));
  EXPECT_EQ(run("fuzz --cases 4 --db a.db").code, 0);
  EXPECT_EQ(run("report a.db -o report --audit audit.json").code, 0);
  write("other.json", "{\"constants\": []}");
  EXPECT_THAT(run("report a.db -o report --audit other.json").error,
              HasSubstr("expected what nearmiss audit --json keeps"));
}

TEST_F(CommandLine, BadStores) {
  write("text.db", "no database, but long enough to look like one if nobody looks at it closely");
  write("taken.db", "precious");
  expect_refused("report text.db -o new", {"text.db", "not a database"});
  expect_refused("report absent.db -o new", {"absent.db: no such file"});
  EXPECT_EQ(run("fuzz --cases 10 --db good.db").code, 0);
  expect_refused("report good.db -o new --power text.db",
                 {"text.db", "expected what nearmiss power --json keeps"});
  expect_refused("report good.db -o new --environments text.db",
                 {"text.db", "expected the table of tools/environments"});
  expect_refused("report good.db -o new --baseline text.db", {"text.db", "not a database"});
  expect_refused("merge new.db absent.db", {"absent.db: no such file"});
  expect_refused("fuzz --cases 10 --db taken.db", {"taken.db: exists already"});
  EXPECT_EQ(read("taken.db"), "precious");
}

TEST_F(CommandLine, HostileArithmeticIsSetRightAndSaid) {
  write("q.vt", hit + "0.25 0.25 1  0 0 0  1 0 0  0 1 0   0.25 0.25 0x1p-1074  0 0 0  1 0 0  0 1 0\n");
  const std::string before = "LD_PRELOAD=" + plugin("hostile");
  const std::string says =
      "nearmiss: found arithmetic that rounds upward, flushes subnormals to zero, takes subnormals for zero, "
      "expected rounding to nearest with subnormals: set so\n";
  const Answer answer = run("oracle --kind vt --distance q.vt", before);
  EXPECT_EQ(answer.error, says);
  EXPECT_EQ(answer.out, run("oracle --kind vt --distance q.vt").out);
  // The threads of a campaign, and the processes of its plug-ins, are as the command is.
  const auto positives = [&](const std::string& preload, const std::string& error) {
    EXPECT_EQ(run("fuzz --family scale@-1070,planted --cases 2000 --quiet --json new.json --subject wang," +
                      plugin("hostile"),
                  preload)
                  .error,
              error);
    const json subjects = read_json("new.json")["subjects"];
    EXPECT_EQ(subjects["hostile"]["vt"]["positives"], 0);
    return subjects["wang"]["vt"]["positives"].get<int>();
  };
  EXPECT_EQ(positives(before, says), positives("", ""));
}

// --- what goes wrong while it works -----------------------------------------------------------------------

TEST_F(CommandLine, AnInterruptSavesEverything) {
  const Answer answer =
      run("fuzz --family uniform --time 60s --db a.db", "timeout --preserve-status -s INT 5");
  EXPECT_EQ(answer.code, 130) << answer.error;
  EXPECT_THAT(answer.out, HasSubstr("no miss in"));
  EXPECT_EQ(run("report a.db -o report").code, 0);
  EXPECT_GT(read_json("report/report.json")["subjects"]["wang"]["vt"]["queries"], 0);
}

TEST_F(CommandLine, AKillLosesNothingThatWasSaved) {
  const Answer answer = run("fuzz --family uniform --time 60s --db a.db", "timeout -s KILL 8");
  EXPECT_EQ(answer.code, 137);
  EXPECT_EQ(run("report a.db -o report").code, 0);
  EXPECT_GT(read_json("report/report.json")["subjects"]["wang"]["vt"]["queries"], 0);
}

TEST_F(CommandLine, AFullDiskIsSaidAndLosesNothingThatWasSaved) {
  // A limit on the size of files stands for the full disk.
  const Answer answer =
      run("fuzz --time 60s --subject basic --family planted --db a.db", "ulimit -f 300; trap '' XFSZ;");
  EXPECT_EQ(answer.code, 2);
  EXPECT_EQ(std::count(answer.error.begin(), answer.error.end(), '\n'), 1) << answer.error;
  EXPECT_THAT(answer.error, HasSubstr("a.db: "));
  EXPECT_EQ(run("merge b.db a.db").code, 0);
  write("q.vt", hit);
  const Answer no_room = run("replay q.vt --json new.json", "ulimit -f 4; trap '' XFSZ;");
  EXPECT_EQ(no_room.code, 2);
  EXPECT_FALSE(std::filesystem::exists(file("new.json")));
  EXPECT_FALSE(std::filesystem::exists(file("new.json.part")));
}

TEST_F(CommandLine, ADeviceIsWrittenToAndNotReplaced) {
  write("q.vt", hit);
  const Answer answer = run("replay q.vt --json /dev/stdout | cat");
  EXPECT_THAT(answer.out, HasSubstr("\"false_negatives\": 0"));
  EXPECT_TRUE(std::filesystem::is_symlink("/dev/stdout"));
}

}  // namespace
}  // namespace nearmiss
