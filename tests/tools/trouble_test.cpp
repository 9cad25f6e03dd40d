// Tests the command line with bad input, and with failures during the work.
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>

#include "tests/reports/stored.hpp"
#include "tests/tools/background.hpp"
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::Background;
using testing::CommandLine;
using ::testing::HasSubstr;

// --- bad input --------------------------------------------------------------------------------------------

TEST_F(CommandLine, BadQueries) {
  const std::string numbers = hit.substr(hit.find(' '));
  write("nan.vt", "# a comment\nnan" + numbers);
  write("inf.vt", hit + "inf" + numbers);
  write("word.vt", "x" + numbers);
  write("few.vt", "1 2 3\n");
  write("many.vt", hit.substr(0, hit.size() - 1) + " 5 6\n");
  write("negative.vt", hit.substr(0, hit.size() - 1) + " -5\n");
  write("empty.vt", "");
  write("comments.vt", "# nothing\n");
  for (const std::string command :
       {"oracle --kind vt ", "verdict --kind vt ", "replay --json new.json --db new.db "}) {
    expect_refused(command + "nan.vt", {"nan.vt:2", "'nan'"});
    expect_refused(command + "inf.vt", {"inf.vt:2", "'inf'"});
    expect_refused(command + "word.vt", {"word.vt:1", "'x'"});
    expect_refused(command + "few.vt", {"few.vt:1", "3", "24"});
    expect_refused(command + "many.vt", {"many.vt:1", "24"});
    expect_refused(command + "negative.vt", {"negative.vt:1", "separation -5"});
    expect_refused(command + "empty.vt", {"empty.vt"});
    expect_refused(command + "comments.vt", {"comments.vt:1"});
    expect_refused(command + "absent.vt", {"absent.vt: cannot be read"});
  }
}

TEST_F(CommandLine, FilesThatAreNone) {
  for (const char* command : {"oracle --kind vt", "verdict --kind vt"}) {
    const Output output = run(command, "", "</");  // a folder can be opened, but not read
    EXPECT_EQ(output.code, 2);
    EXPECT_EQ(output.error, "nearmiss: stdin: cannot be read to its end\n");
  }
  for (const char* make : {"mkdir x.vt x.obj x.db", "mkfifo x.vt x.obj x.db"}) {
    ASSERT_EQ(std::system(("cd " + file("").string() + " && rm -rf x.* && " + make).c_str()), 0);
    const std::string found = std::string(make).starts_with("mkdir") ? "found a folder" : "found a pipe";
    if (found == "found a pipe")
      expect_refused("replay x.vt --db new.db", {"x.vt: " + found, "expected a file"});
    expect_refused("scene x.obj x.obj --db new.db", {"x.obj: " + found});
    expect_refused("fuzz --cases 10 --mesh x.obj x.obj --db new.db", {"x.obj: " + found});
    expect_refused("report x.db -o new", {"x.db: " + found});
  }
}

TEST_F(CommandLine, AWrongNumberOfLanes) {
  for (const char* wrong : {"3", "16", "x", "-2", "8 "}) {
    const Output output = expect_code(2, "subjects", std::string("NEARMISS_LANES='") + wrong + "'");
    EXPECT_EQ(output.error,
              "nearmiss: NEARMISS_LANES: found '" + std::string(wrong) + "', expected 2, 4 or 8\n");
  }
  for (const char* right : {"", "2"})
    EXPECT_EQ(run("subjects", std::string("NEARMISS_LANES=") + right).code, 0);
}

TEST_F(CommandLine, ArgumentsWithoutAValue) {
  expect_refused("fuzz --time ''", {"found an empty argument after '--time', expected a value"});
  expect_refused("fuzz --cases 10 --subject ,", {"found an empty list after '--subject', expected a value"});
  expect_refused("fuzz --cases 10 --db=", {"found '--db=', expected a value"});
  expect_refused("fuzz --cases 10 --json ''", {"after '--json'"});
  for (const std::string size : {"-1", "99999999999999999999G", "18014398509481984K", "1X", "1Gi", "iB", ""})
    expect_refused("verdict --kind vt --query-memory '" + size + "'",
                   {size.empty() ? "--query-memory" : "--query-memory: found '" + size + "'"});
  expect_refused("power --time nan --json new.json", {"--time: found 'nan'"});
  EXPECT_EQ(run("fuzz --cases 100 --db a.db").code, 0);
  expect_refused("report a.db -o ''", {"after '-o'"});
  expect_refused("fuzz --cases 10 --db new.db --json ./new.db", {"found the same file for --json and --db"});
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
  expect_refused("fuzz --cases 10 --shard 0/18446744073709551615",
                 {"--shard: found '0/18446744073709551615', expected I/N with 0 <= I < N <= 1000000"});
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
  refused("version_1", {"version_1.so", "found version 1 of the plug-in interface", "expected 2"});
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

// --- failures during the work -----------------------------------------------------------------------------

TEST_F(CommandLine, HostileArithmeticIsCorrectedAndReported) {
  write("q.vt", hit + "0.25 0.25 1  0 0 0  1 0 0  0 1 0   0.25 0.25 0x1p-1074  0 0 0  1 0 0  0 1 0\n");
  const std::string before = "LD_PRELOAD=" + plugin("hostile");
  const std::string says =
      "nearmiss: found arithmetic that rounds upward, flushes subnormals to zero, takes subnormals for zero, "
      "expected rounding to nearest with subnormals; changed to that\n";
  const Output output = run("oracle --kind vt --distance q.vt", before);
  EXPECT_EQ(output.error, says);
  EXPECT_EQ(output.out, run("oracle --kind vt --distance q.vt").out);
  // The threads of a campaign, and the processes of its plug-ins, compute with the arithmetic of the command.
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

constexpr const char* endless_campaign = "fuzz --family uniform --time 24h --db a.db";

TEST_F(CommandLine, ACampaignOutlastsALockOfItsStore) {
  Background campaign(file(""), endless_campaign);
  ASSERT_TRUE(wait_for_a_save(campaign)) << read("error.txt");
  {
    const testing::Database other(file("a.db"));
    other.execute("PRAGMA busy_timeout = 60000; BEGIN IMMEDIATE");
    std::this_thread::sleep_for(std::chrono::seconds(3));  // longer than a save waits
    EXPECT_FALSE(campaign.has_ended()) << read("error.txt");
  }
  ASSERT_TRUE(wait_for_a_save(campaign)) << read("error.txt");
  campaign.stop(SIGINT);
  EXPECT_EQ(campaign.code(), 130) << read("error.txt");
  EXPECT_GT(report_of("a.db")["subjects"]["wang"]["vt"]["queries"], 0);
}

TEST_F(CommandLine, ASceneOutlastsALockOfItsStore) {
  Background scene(file(""), "scene tumbling@100000 --subject wang --db a.db");
  ASSERT_TRUE(wait_for_a_save(scene)) << read("error.txt");
  {
    const testing::Database other(file("a.db"));
    other.execute("PRAGMA busy_timeout = 60000; BEGIN IMMEDIATE");
    scene.send(SIGINT);  // it saves, and saves its picture, while the store is locked
    std::this_thread::sleep_for(std::chrono::seconds(4));
    EXPECT_FALSE(scene.has_ended()) << read("error.txt");
  }
  scene.stop(0);
  EXPECT_EQ(scene.code(), 130) << read("error.txt");
  EXPECT_EQ(report_of("a.db")["pictures"].size(), 1);
}

TEST_F(CommandLine, AnInterruptSavesEverything) {
  write_falling_triangle();
  std::string queries;
  for (int i = 0; i < 100'000; ++i) queries += miss;
  write("q.vt", queries);
  constexpr int all = 500;
  const std::vector<std::pair<std::string, int>> commands{
      {"fuzz --time 24h --family uniform", 1},
      {"fuzz --time 24h --sweep stiff", 1},
      {"fuzz --time 24h --search --family uniform", 1},
      {"fuzz --time 24h --mesh start.obj end.obj --family mesh", 1},
      {fmt::format("fuzz --cases {} --subject {}", all, plugin("crash")), all},  // while it shrinks
      {"ladder --time 24h", 1},
      {"tightness --time 24h --values 0,1 --subject '" + plugin("sampling") + ":tolerance=*'", 1},
      {"scene tumbling@100000", 1},
      {"scene tumbling@20000 --verify-plan", 1},
      {"replay q.vt --subject " + plugin("waits"), 1}};
  for (const auto& [command, cases] : commands) {
    Background process(file(""), command + " --db a.db", "NEARMISS_ONE_IN=2");
    ASSERT_TRUE(wait_for_a_save(process, cases)) << command << read("error.txt");
    process.stop(SIGINT);
    EXPECT_EQ(process.code(), 130) << command << read("error.txt");
    EXPECT_THAT(read("out.txt"), HasSubstr("\noracle: ")) << command;
    EXPECT_LE(run("report a.db -o report").code, 1) << command;
    EXPECT_GE(read_json("report/report.json")["runs"][0]["cases_done"], cases) << command;
    std::filesystem::remove(file("a.db"));
  }
}

TEST_F(CommandLine, AKillLosesNothingThatWasSaved) {
  Background campaign(file(""), endless_campaign);
  ASSERT_TRUE(wait_for_a_save(campaign)) << read("error.txt");
  campaign.stop(SIGKILL);
  EXPECT_GT(report_of("a.db")["subjects"]["wang"]["vt"]["queries"], 0);
}

TEST_F(CommandLine, AFullDiskIsReportedAndLosesNothingThatWasSaved) {
  // A limit on the size of files simulates a full disk.
  const Output output = expect_code(2, "fuzz --time 24h --subject basic --family planted --db a.db",
                                    "ulimit -f 1200; trap '' XFSZ;");
  EXPECT_EQ(std::count(output.error.begin(), output.error.end(), '\n'), 1) << output.error;
  EXPECT_THAT(output.error, HasSubstr("a.db: "));
  EXPECT_EQ(run("merge b.db a.db").code, 1);
  write("q.vt", hit);
  expect_code(2, "replay q.vt --json new.json", "ulimit -f 4; trap '' XFSZ;");
  EXPECT_FALSE(std::filesystem::exists(file("new.json")));
  EXPECT_FALSE(std::filesystem::exists(file("new.json.part")));
}

TEST_F(CommandLine, AFullDiskLeavesNoPartOfAStoreWithoutResults) {
  if (std::system("unshare -rm true 2>/dev/null") != 0) GTEST_SKIP() << "found no permission to mount a disk";
  // The disk has room for the store's tables, but not for results. It exists as long as the shell.
  const std::string with_disk =
      "unshare -rm sh -c 'mkdir disk && mount -t tmpfs -o size=400k none disk && \"$@\"; code=$?; ls disk > "
      "left.txt; "
      "exit $code' sh";
  const Output output =
      expect_code(2, "fuzz --quiet --cases 4000 --subject basic,wang,exact --db disk/a.db", with_disk);
  EXPECT_EQ(output.error, "nearmiss: disk/a.db: database or disk is full\n");
  EXPECT_EQ(read("left.txt"), "");
}

TEST_F(CommandLine, AFullDiskLeavesNoPartOfAnExport) {
  const Output output = expect_code(2, "scene spikes@400 --subject wang --export pairs", "ulimit -f 8;");
  EXPECT_THAT(output.error, HasSubstr("cannot be written"));
  for (const auto& each : std::filesystem::directory_iterator(file("")))
    EXPECT_THAT(each.path().filename().string(), ::testing::Not(::testing::StartsWith("pairs")));
}

TEST_F(CommandLine, OutputWithoutAReaderIsAnError) {
  (void)run("family uniform --seed 1 --kind vt --count 100000", "{",
            ">&3; echo $? >code.txt; } 3>&1 >none.txt | true");
  EXPECT_EQ(read("code.txt"), "2\n");
  EXPECT_EQ(read("error.txt"), "nearmiss: standard output cannot be written: Broken pipe\n");
  const Output output = expect_code(2, "family uniform --seed 1 --kind vt --count 100000", "ulimit -f 8;");
  EXPECT_EQ(output.error, "nearmiss: standard output cannot be written: File too large\n");
}

/// A mesh of triangles that are all in one place, so that it takes minutes to look at all pairs.
std::string crowd() {
  constexpr int triangles = 20'000;
  std::string vertices;
  std::string faces;
  for (int i = 0; i < triangles; ++i) {
    vertices += "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    faces += fmt::format("f {} {} {}\n", 3 * i + 1, 3 * i + 2, 3 * i + 3);
  }
  return vertices + faces;
}

TEST_F(CommandLine, AnInterruptEndsACommandThatSavesNothing) {
  ASSERT_EQ(mkfifo(file("endless").c_str(), 0600), 0);
  write("crowd.obj", crowd());
  write("hit.vt", hit);
  const std::string hang = " --query-time 24h --subject " + plugin("hang");
  const std::vector<std::string> commands{"verdict --kind vt <>endless",
                                          "verdict --kind vt hit.vt" + hang,
                                          "oracle --kind vt <>endless",
                                          "family uniform --seed 1 --kind vt --count 1000000000",
                                          "shrink hit.vt" + hang,
                                          "replay hit.vt" + hang,
                                          "bench --runs 1000000",
                                          "bench --queries 4000000000",
                                          "bench hit.vt" + hang,
                                          "power --time 24h",
                                          "tightness --time 24h",
                                          "fuzz --cases 10 --subject " + plugin("escaping_stop_while_loaded"),
                                          "fuzz --mesh crowd.obj crowd.obj --family mesh --cases 10",
                                          "scene knot@1000000",
                                          "scene crowd.obj crowd.obj --bound pair,scene",
                                          "scene crowd.obj crowd.obj --thickness 1",
                                          "scene crowd.obj crowd.obj --export pairs"};
  for (const std::string& command : commands)
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      Background process(file(""), command, "NEARMISS_ONE_IN=1");
      ASSERT_TRUE(process.wait_until_it_handles_interrupts()) << command;
      process.stop(signal);
      EXPECT_EQ(process.code(), 130) << command;
    }
}

TEST_F(CommandLine, ATimeLimitCountsTheCollectingOfPairs) {
  write("crowd.obj", crowd());
  expect_refused("fuzz --mesh crowd.obj crowd.obj --family mesh --time 100ms --db new.db",
                 {"--time: found 100ms, expected more time"});
}

TEST_F(CommandLine, AClosedStandardStreamIsAnErrorWhereItIsNeeded) {
  write("q.vt", hit);
  const std::string fuzz = "fuzz --cases 100 --family uniform --subject wang," + plugin("example");
  const Output unwritten = expect_code(2, fuzz + " --db a.db", "", ">&-");
  EXPECT_THAT(unwritten.error, HasSubstr("nearmiss: standard output cannot be written: "));
  EXPECT_EQ(report_of("a.db")["subjects"]["wang"]["vt"]["queries"], 50);
  const Output unread = expect_code(2, "oracle --kind vt -", "", "<&-");
  EXPECT_THAT(unread.error, HasSubstr("nearmiss: stdin"));
}

TEST_F(CommandLine, AClosedStandardStreamDoesNotMatterWhereItIsNotNeeded) {
  write("q.vt", hit);
  const std::string replay = "replay q.vt --subject wang," + plugin("print") + " --db ";
  expect_code(0, replay + "a.db", "", "<&-");
  const Output silent = expect_code(0, replay + "b.db", "", "2>&-");
  EXPECT_THAT(silent.out, HasSubstr(" ok  wang: no miss in 1 collision"));
  // No printed text gets into the store or its lock, although their files may have the numbers of closed
  // streams.
  EXPECT_EQ(run(replay + "c.db", "", "<&- >&- 2>&-").code, 2);
  for (const char* store : {"a.db", "b.db", "c.db"})
    EXPECT_EQ(run(std::string("report ") + store + " -o report").code, 0) << store;
}

}  // namespace
}  // namespace nearmiss
