// A campaign gives the same report if it is interrupted, killed, divided into shards, or run by more threads.
#include <chrono>
#include <csignal>

#include "tests/tools/background.hpp"
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::Background;
using testing::CommandLine;
using ::testing::HasSubstr;

class Resume : public CommandLine {
 protected:
  static constexpr const char* campaign = "fuzz --cases 10000 --seed 9 --subject basic,wang";

  /// The report of a store, without its times.
  [[nodiscard]] json timeless_report(const std::string& store) const {
    EXPECT_LE(run("report " + store + " -o report").code, 1);
    json report = read_json("report/report.json");
    forget_times(report);
    return report;
  }

  /// Starts or resumes a campaign in a.db, waits until it has saved, waits a further time, and sends it a
  /// signal. Returns the exit code; -1 if the signal ended the process.
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
  EXPECT_EQ(run(std::string(campaign) + " --jobs 1 --db one.db").code, 1);
  EXPECT_EQ(run(std::string(campaign) + " --jobs 2 --db two.db").code, 1);
  const json report = timeless_report("one.db");
  EXPECT_GT(report["findings"].size(), 10);
  EXPECT_EQ(timeless_report("two.db"), report);

  EXPECT_EQ(run(std::string(campaign) + " --no-shrink --db plain.db").code, 1);
  for (const json& finding : timeless_report("plain.db")["findings"])
    EXPECT_EQ(finding["shrunk"], finding["original"]);
  EXPECT_EQ(run(std::string(campaign) + " --resume --db plain.db").code, 1);
  json later = timeless_report("plain.db");
  later["runs"] = report["runs"];  // its command has the option --no-shrink
  EXPECT_EQ(later, report);

  std::string shards;
  for (const int shard : {2, 0, 1}) {
    const std::string number = std::to_string(shard);
    std::string command = campaign;
    command.append(" --shard ").append(number).append("/3 --db ").append(number).append(".db");
    EXPECT_LE(run(command).code, 1);
    shards.append(" ").append(number).append(".db");
  }
  EXPECT_EQ(run("merge merged.db" + shards).code, 1);
  EXPECT_EQ(timeless_report("merged.db"), report);

  int kills = 0;
  // The waiting times before a signal extend beyond the interval between two saves. They grow until the
  // campaign completes, even on a slow machine.
  while (run_until_a_signal(campaign, std::chrono::milliseconds(137 * kills % 1000 + 20 * kills),
                            kills % 4 == 3 ? SIGINT : SIGKILL) != 1)
    ++kills;
  RecordProperty("kills", kills);
  EXPECT_GT(kills, 0);
  EXPECT_EQ(timeless_report("a.db"), report);
  // A resume of a complete campaign does not run it again.
  EXPECT_EQ(run(std::string(campaign) + " --db a.db --resume").code, 1);
  EXPECT_EQ(timeless_report("a.db"), report);
}

TEST_F(Resume, TheReportOnAPluginIsTheSameHoweverTheCampaignWasRun) {
  const std::string sampling = "fuzz --cases 2000 --seed 9 --subject " + plugin("sampling") + ":tolerance=0";
  EXPECT_EQ(run(sampling + " --jobs 1 --db one.db").code, 1);
  EXPECT_EQ(run(sampling + " --jobs 2 --db two.db").code, 1);
  const json report = timeless_report("one.db");
  EXPECT_GT(report["findings"].size(), 10);
  EXPECT_EQ(json::diff(report, timeless_report("two.db")), json::array());
  int interruptions = 0;
  while (run_until_a_signal(sampling, std::chrono::milliseconds(100 + 500 * interruptions),
                            interruptions % 2 == 0 ? SIGKILL : SIGINT) != 1)
    ++interruptions;
  EXPECT_GT(interruptions, 0);
  EXPECT_EQ(json::diff(report, timeless_report("a.db")), json::array());
}

TEST_F(Resume, ResumesOnlyTheSameCampaign) {
  EXPECT_EQ(run("fuzz --cases 100 --db a.db --resume").code, 0);  // starts, because there is no store yet
  expect_refused("fuzz --cases 100 --seed 2 --db a.db --resume",
                 {"a.db: found a run with seed '1', expected '2'"});
  expect_refused("fuzz --cases 100 --subject basic --db a.db --resume",
                 {"subjects 'wang', expected 'basic'"});
  expect_refused("fuzz --cases 100 --shard 0/2 --db a.db --resume", {"shard '0/1', expected '0/2'"});
  expect_refused("fuzz --cases 100 --db a.db", {"a.db: exists already"});
  EXPECT_EQ(run("replay none --db b.db").code, 2);
}

TEST_F(Resume, AMergeNamesMissingShardsAndRefusesAShardTwice) {
  EXPECT_EQ(run("fuzz --cases 300 --shard 0/3 --db a.db").code, 0);
  EXPECT_EQ(run("fuzz --cases 300 --shard 2/3 --db c.db").code, 0);
  const Output output = expect_code(0, "merge some.db a.db c.db");
  EXPECT_THAT(output.out, HasSubstr("fuzz: shards 1 of 3 are missing"));
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
  other["runs"] = report["runs"];  // its command has a number of cases instead of a time
  EXPECT_EQ(other, report);
}

TEST_F(Resume, TimeThatIsSpentIsNotGivenAgain) {
  EXPECT_EQ(run("fuzz --time 1s --db a.db").code, 0);
  const json report = timeless_report("a.db");
  EXPECT_EQ(run("fuzz --time 1s --db a.db --resume").code, 0);
  EXPECT_EQ(timeless_report("a.db"), report);
}

TEST_F(Resume, AStopDoesNotWaitForASubject) {
  const std::string hangs = "fuzz --family uniform --subject wang," + plugin("hang") +
                            " --query-time 24h --query-memory 0 --db a.db --resume --time ";
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    Background hanging(file(""), hangs + "24h");
    ASSERT_TRUE(hanging.wait_for_a_change(file("a.db.lock")));
    hanging.stop(signal);
    EXPECT_EQ(hanging.code(), 130);
    EXPECT_EQ(run("report a.db -o report").code, 0);
  }
  EXPECT_EQ(run(hangs + "1s").code, 0);
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
  EXPECT_EQ(run("fuzz --time 1s --db a.db --resume").code, 0);
}

}  // namespace
}  // namespace nearmiss
