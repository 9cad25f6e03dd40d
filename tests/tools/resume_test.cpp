// Tests that a campaign gives the same report if it is interrupted, killed, divided into shards, or run by
// more threads. Also tests the comparison of two versions of a CCD: their names, the queries that the second
// version fixes or breaks, and the replay of a broken query.
#include <chrono>
#include <csignal>

#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::Background;
using testing::CommandLine;
using ::testing::HasSubstr;
using ::testing::Not;

class Resume : public CommandLine {
 protected:
  [[nodiscard]] json timeless_report(const std::string& store) const {
    EXPECT_LE(run("report " + store + " -o report").code, 1);
    json report = read_json("report/report.json");
    forget_times(report);
    return report;
  }

  /// Starts or resumes a campaign in a.db. Waits until the campaign has saved results, then waits for the
  /// time `after`, and sends it a signal. Returns the campaign's exit code, or -1 if the signal ended the
  /// process.
  [[nodiscard]] int run_until_a_signal(const std::string& command, std::chrono::milliseconds after,
                                       int signal) const {
    Background process(file(""), command + " --db a.db --resume");
    process.wait_for_a_change(file("a.db-wal"));
    const auto end = std::chrono::steady_clock::now() + after;
    if (process.wait_until([&] { return std::chrono::steady_clock::now() >= end; })) process.stop(signal);
    return process.code();
  }

 private:
  static void forget_times(json& node) {
    if (node.is_object())
      for (const char* name :
           {"started", "seconds", "ns_per_query", "times", "front_by_distance", "front_by_rate"})
        node.erase(name);
    if (node.is_structured())
      for (json& each : node) forget_times(each);
  }
};

TEST_F(Resume, TheReportIsTheSameHoweverTheCampaignWasRun) {
  // One of these subjects is a plug-in. All of these subjects have findings in these families.
  const std::string campaign =
      "fuzz --cases 1500 --seed 9 --family small-integer,uniform,planted,v-uniform --subject basic,wang," +
      plugin("sampling") + ":tolerance=0";
  expect_code(1, campaign + " --jobs 1 --db one.db");
  expect_code(1, campaign + " --jobs 2 --db two.db");
  const json report = timeless_report("one.db");
  EXPECT_GT(report["findings"].size(), 10);
  EXPECT_EQ(json::diff(timeless_report("two.db"), report), json::array());

  expect_code(1, campaign + " --no-shrink --db plain.db");
  for (const json& finding : timeless_report("plain.db")["findings"])
    EXPECT_EQ(finding["shrunk"], finding["original"]);
  expect_code(1, campaign + " --resume --db plain.db");
  json later = timeless_report("plain.db");
  later["runs"] = report["runs"];  // only one of the commands has --no-shrink
  EXPECT_EQ(json::diff(later, report), json::array());

  for (const std::string shard : {"2", "0", "1"})
    EXPECT_LE(run(campaign + " --shard " + shard + "/3 --db " + shard + ".db").code, 1);
  expect_code(1, "merge merged.db 2.db 0.db 1.db");
  EXPECT_EQ(json::diff(timeless_report("merged.db"), report), json::array());

  int kills = 0;
  // Some delays before a signal are longer than the interval between two saves. The delays grow from kill to
  // kill, so that the campaign completes even on a slow machine.
  while (run_until_a_signal(campaign, std::chrono::milliseconds(337 * kills % 1000 + 50 * kills),
                            kills % 4 == 3 ? SIGINT : SIGKILL) != 1)
    ++kills;
  RecordProperty("kills", kills);
  EXPECT_GT(kills, 0);
  EXPECT_EQ(json::diff(timeless_report("a.db"), report), json::array());
  // Resuming a complete campaign does not run it again.
  expect_code(1, campaign + " --db a.db --resume");
  EXPECT_EQ(json::diff(timeless_report("a.db"), report), json::array());
}

TEST_F(Resume, ResumesOnlyTheSameCampaign) {
  expect_code(0, "fuzz --cases 100 --db a.db --resume");  // starts a campaign, because there is no store
  expect_refused("fuzz --cases 100 --seed 2 --db a.db --resume",
                 {"a.db: found a run with seed '1', expected '2'"});
  expect_refused("fuzz --cases 100 --subject basic --db a.db --resume",
                 {"subjects 'wang', expected 'basic'"});
  expect_refused("fuzz --cases 100 --shard 0/2 --db a.db --resume", {"shard '0/1', expected '0/2'"});
}

TEST_F(Resume, AMergeNamesMissingShardsAndRefusesAShardTwice) {
  expect_code(0, "fuzz --cases 300 --shard 0/3 --db a.db");
  expect_code(0, "fuzz --cases 300 --shard 2/3 --db c.db");
  EXPECT_THAT(expect_code(0, "merge some.db a.db c.db").out, HasSubstr("fuzz: shards 1 of 3 are missing"));
  EXPECT_EQ(timeless_report("some.db")["runs"][0]["missing"], "shards 1 of 3 are missing");
  expect_refused("merge new.db a.db c.db a.db", {"a.db and a.db: both have shard 0/3 of the run with"});
}

TEST_F(Resume, TheCommandInAReportGivesTheSameAgain) {
  const int code =
      run("fuzz --time 1s --no-shrink --seed 9 --subject basic,wang --sweep needle --steps 3 --db timed.db")
          .code;
  const json report = timeless_report("timed.db");
  const std::string again = report["runs"][0]["again"];
  ASSERT_EQ(again.rfind("nearmiss ", 0), 0);
  EXPECT_EQ(run(again.substr(9) + " --db again.db").code, code);
  json other = timeless_report("again.db");
  other["runs"] = report["runs"];  // one command limits the cases, and the other limits the time
  EXPECT_EQ(other, report);
}

TEST_F(Resume, AStopDoesNotWaitForASubject) {
  const std::string hangs = "fuzz --family uniform --subject wang," + plugin("hang") +
                            " --query-time 24h --query-memory 0 --db a.db --resume --time ";
  Background hanging(file(""), hangs + "24h");
  ASSERT_TRUE(hanging.wait_for_a_change(file("a.db.lock")));
  hanging.stop(SIGTERM);
  EXPECT_EQ(hanging.code(), 130);
  expect_code(0, "report a.db -o report");
  expect_code(0, hangs + "1s");
}

TEST_F(Resume, AnInterruptedCampaignPrintsTheCommandThatContinuesIt) {
  for (const std::string command :
       {"fuzz --time 24h --db 'a b.db' -q", "fuzz --time 24h --db 'a b.db' -q --resume"}) {
    Background process(file(""), command);
    ASSERT_TRUE(process.wait_for_a_change(file("a b.db-wal")));
    process.stop(SIGTERM);
    EXPECT_EQ(process.code(), 130);
    EXPECT_EQ(read("error.txt"), std::string("nearmiss: interrupted; to continue: ") + NEARMISS_EXECUTABLE +
                                     " fuzz --time 24h --db 'a b.db' -q --resume\n");
  }
}

TEST_F(Resume, OneProcessWritesAStore) {
  Background first(file(""), "fuzz --time 24h --db a.db");
  ASSERT_TRUE(first.wait_for_a_change(file("a.db-wal")));
  expect_refused("fuzz --time 1s --db a.db --resume", {"a.db: another process is writing it"});
  first.stop(SIGTERM);
  EXPECT_EQ(first.code(), 130);
  // --time limits the total time of a campaign, so resuming a campaign that has spent its time does nothing.
  expect_code(0, "fuzz --time 1s --db a.db --resume");
  const json report = timeless_report("a.db");
  expect_code(0, "fuzz --time 1s --db a.db --resume");
  EXPECT_EQ(timeless_report("a.db"), report);
}

class VersionsOfACcd : public CommandLine {
 protected:
  VersionsOfACcd() {
    std::filesystem::copy(plugin("v1"), file("v1.so"));
    std::filesystem::copy(plugin("v2"), file("v2.so"));
  }

  /// The sum of the numbers with the key `of`, over all classes and kinds.
  static std::uint64_t sum(const nlohmann::json& versions, const char* of) {
    std::uint64_t sum = 0;
    for (const auto& each : versions) sum += each[of].get<std::uint64_t>();
    return sum;
  }
};

TEST_F(VersionsOfACcd, AreNamedAsTheirFilesAndCompared) {
  const Output output =
      expect_code(1, "fuzz --subject ./v1.so,./v2.so --family small-integer,uniform --cases 400 --db a.db");
  EXPECT_THAT(output.out, HasSubstr("v2 against v1: "));
  EXPECT_THAT(output.out, HasSubstr("v1 answers rightly, and v2 does not:"));
  const auto report = report_of("a.db", 1);
  const auto& versions = report["versions"];
  EXPECT_EQ(sum(versions, "queries"), 400);
  EXPECT_EQ(
      sum(versions, "fixed") + sum(versions, "broken") + sum(versions, "both") + sum(versions, "neither"),
      400);
  const auto missed_by = [&](const char* subject) {
    return report["subjects"][subject]["vt"]["false_negatives"].get<std::uint64_t>() +
           report["subjects"][subject]["ee"]["false_negatives"].get<std::uint64_t>();
  };
  EXPECT_EQ(sum(versions, "both") + sum(versions, "fixed"), missed_by("v1"));
  EXPECT_EQ(sum(versions, "both") + sum(versions, "broken"), missed_by("v2"));
  EXPECT_GT(sum(versions, "fixed"), 0);
  EXPECT_GT(sum(versions, "broken"), 0);
}

TEST_F(VersionsOfACcd, SayWhichKindIsNotCompared) {
  const Output output =
      run("fuzz --subject " + plugin("several") + ":edges,wang,never=" + plugin("never_asked") +
          " --versions wang,never --family uniform --cases 20 --db a.db");
  EXPECT_THAT(output.out,
              HasSubstr("never against wang: no query was asked of both; vt not compared, because "
                        "never was not asked about it; ee not compared, because never was not"));
  const auto versions = report_of("a.db", output.code)["versions"];
  EXPECT_FALSE(versions.empty());
  EXPECT_EQ(sum(versions, "queries"), 0);
  EXPECT_THAT(run("fuzz --subject ./v1.so,old=" + plugin("v3") + " --family uniform --cases 20").out,
              HasSubstr("; ee not compared, because old was not asked about it\n"));
  EXPECT_THAT(run("fuzz --subject ./v1.so,./v2.so,wang --family uniform --cases 20").out,
              Not(HasSubstr("not compared")));
}

TEST_F(VersionsOfACcd, ThatAreProgramsAreNamedAndReplayedByTheirFiles) {
  std::string program = read(NEARMISS_EXAMPLES "/example.py");
  program.replace(program.find("~apart.any(1)"), 1, "");  // misses all collisions
  for (const char* folder : {"lib", "elsewhere"}) std::filesystem::create_directory(file(folder));
  for (const char* version : {"one.py", "lib/two.py"}) write(version, program);
  const std::string python = "pipe:" NEARMISS_PYTHON " ";
  const Output output = run("fuzz --subject '" + python + "one.py," + python +
                            "lib/two.py 2>/dev/null # *' --family small-integer --cases 40 --db a.db");
  EXPECT_THAT(output.out, HasSubstr("two against one: "));
  const auto findings = report_of("a.db", output.code)["findings"];
  ASSERT_FALSE(findings.empty());
  for (const auto& finding : {findings.front(), findings.back()}) {
    const std::string again = std::string(finding["again"]).substr(std::string("nearmiss replay ").size());
    expect_code(1, "replay ../report/" + again, "cd elsewhere &&");
    expect_code(1, "replay report/" + again);
  }
  expect_refused("bench --subject '" + python + "one.py," + python + "one.py'",
                 {"such as 'NAME=pipe:" NEARMISS_PYTHON " one.py'"});
  // A word that is too long for a file name must not be taken for a file.
  expect_refused("bench --subject '" + python + "one.py," + python + "one.py " + std::string(300, 'x') + "'",
                 {"two subjects named"});
}

TEST_F(VersionsOfACcd, AreReplayedUnderTheirNames) {
  expect_code(1, "fuzz --subject old=./v1.so,new=./v2.so --family uniform --cases 400 --db a.db");
  const auto findings = report_of("a.db", 1)["findings"];
  for (const auto& finding : findings) {
    if (!finding.contains("broken_since")) continue;
    const std::string again = finding["again"];
    EXPECT_THAT(again,
                HasSubstr(" --subject old=" + file("v1.so").string() + ",new=" + file("v2.so").string()));
    std::filesystem::copy(file("report") / finding["original_file"], file("broken.case"));
    const std::string subjects = again.substr(again.find(" --subject"));
    const Output output = run("replay broken.case" + subjects);
    EXPECT_THAT(output.out, HasSubstr("new against old: 0 fixed, 1 broken, 0 both fail, of 1 query"));
    return;
  }
  FAIL() << "no finding is broken";
}

TEST_F(VersionsOfACcd, MergeToTheSameComparison) {
  const std::string fuzz =
      "fuzz --subject ./v1.so,./v2.so --family small-integer --cases 1000 --no-shrink -q ";
  const auto whole = json_of(1, fuzz)["versions"];
  for (const std::string shard : {"0", "1"})
    expect_code(1, fuzz + "--db " + shard + ".db --shard " + shard + "/2");
  expect_code(1, "merge all.db 1.db 0.db");
  EXPECT_EQ(report_of("all.db", 1)["versions"], whole);
}

TEST_F(VersionsOfACcd, CanBeChosenByDifferentNames) {
  const std::string fuzz = "fuzz --subject basic,other=wang --family uniform --cases 100 --versions ";
  EXPECT_THAT(run(fuzz + "basic,other").out, HasSubstr("other against basic: "));
  expect_refused(fuzz + "basic,wang", {"--versions: found 'wang'"});
  expect_refused(fuzz + "basic,basic", {"--versions: found 'basic' twice, expected two subjects"});
  expect_refused("fuzz --cases 10 --subject ./v1.so,./v1.so --db new.db",
                 {"found two subjects named 'always', expected different names, such as NAME=./v1.so"});
}

TEST_F(VersionsOfACcd, AreRenamedForEveryCommand) {
  EXPECT_EQ(run("subjects new=./v1.so").out.substr(0, 4), "new ");
  EXPECT_EQ(run("subjects --targets new=./v1.so").out, "false_negative new=./v1.so\n");
  EXPECT_THAT(run("verdict --kind vt --subject new=" + plugin("error") + " hit.vt").error,
              HasSubstr("new: no answer"));
  EXPECT_THAT(run("shrink hit.vt --subject new=" + plugin("never")).out, HasSubstr("false-negative of new"));
  EXPECT_THAT(run("scene spikes@100 --bound pair,scene --subject old=wang,./v1.so,./v2.so").out,
              ::testing::AllOf(HasSubstr("old@scene: "), HasSubstr("v2 against v1: ")));
  EXPECT_THAT(run("bench hit.vt --queries 1 --runs 1 --subject ./v1.so,./v2.so").out, HasSubstr(" v2 "));
}

}  // namespace
}  // namespace nearmiss
