// A campaign that is interrupted, killed, cut into shards or run by more threads gives the same report.
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::CommandLine;
using ::testing::HasSubstr;

class Resume : public CommandLine {
 protected:
  static constexpr const char* campaign = "fuzz --cases 20000 --seed 9 --subject basic,wang";

  /// The report of a store, without what is told of time.
  [[nodiscard]] json timeless_report(const std::string& store) const {
    EXPECT_EQ(run("report " + store + " -o report").code, 0);
    json report = read_json("report/report.json");
    forget_times(report);
    return report;
  }

  /// Starts the campaign or goes on with it in a.db, and sends it a signal a while after it has saved
  /// something. Its exit code; -1 where the signal ended it.
  [[nodiscard]] int run_until_a_save(std::chrono::milliseconds after, int signal) const {
    const auto log = file("a.db-wal");
    const pid_t child = fork();
    if (child == 0) {
      const std::string command = "cd " + file("").string() + " && exec " + NEARMISS_EXECUTABLE + " " +
                                  campaign + " --db a.db --resume >out.txt 2>error.txt";
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(127);
    }
    int status = 0;
    const auto ended = [&] { return waitpid(child, &status, WNOHANG) == child; };
    const auto rounds = [&] {
      std::error_code none;
      return std::filesystem::last_write_time(log, none);
    };
    // The store is opened first, which may write; then a save comes half a second later or more.
    const auto wait = [&](std::chrono::milliseconds time) {
      for (; time.count() > 0; time -= std::chrono::milliseconds(10)) {
        if (ended()) return false;
        usleep(10000);
      }
      return true;
    };
    bool runs = wait(std::chrono::milliseconds(300));
    for (const auto opened = rounds(); runs && rounds() == opened;)
      runs = wait(std::chrono::milliseconds(10));
    if (runs && wait(after)) {
      kill(child, signal);
      waitpid(child, &status, 0);
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
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

  std::string shards;
  for (const int shard : {4, 0, 6, 2, 5, 1, 3}) {
    const std::string number = std::to_string(shard);
    EXPECT_LE(run(std::string(campaign) + " --shard " + number + "/7 --db " + number + ".db").code, 1);
    shards += " " + number + ".db";
  }
  EXPECT_EQ(run("merge merged.db" + shards).code, 0);
  EXPECT_EQ(timeless_report("merged.db"), report);

  int kills = 0;
  while (run_until_a_save(std::chrono::milliseconds(37 * kills % 400), kills % 4 == 3 ? SIGINT : SIGKILL) !=
         1) {
    ASSERT_LT(kills, 60) << read("error.txt");
    ++kills;
  }
  RecordProperty("kills", kills);
  EXPECT_GT(kills, 0);
  EXPECT_EQ(timeless_report("a.db"), report);
  // What is complete is not run again.
  EXPECT_EQ(run(std::string(campaign) + " --db a.db --resume").code, 1);
  EXPECT_EQ(timeless_report("a.db"), report);
}

TEST_F(Resume, GoesOnWithTheSameCampaignOnly) {
  EXPECT_EQ(run("fuzz --cases 100 --db a.db --resume").code, 0);  // there is none yet: it begins
  expect_refused("fuzz --cases 100 --seed 2 --db a.db --resume",
                 {"a.db: found a run with seed '1', expected '2'"});
  expect_refused("fuzz --cases 100 --subject basic --db a.db --resume",
                 {"subjects 'wang', expected 'basic'"});
  expect_refused("fuzz --cases 100 --shard 0/2 --db a.db --resume", {"shard '0/1', expected '0/2'"});
  expect_refused("fuzz --cases 100 --db a.db", {"a.db: exists already"});
  EXPECT_EQ(run("replay none --db b.db").code, 2);
}

TEST_F(Resume, AMergeSaysWhichShardsAreMissingAndRefusesOneTwice) {
  EXPECT_EQ(run("fuzz --cases 300 --shard 0/3 --db a.db").code, 0);
  EXPECT_EQ(run("fuzz --cases 300 --shard 2/3 --db c.db").code, 0);
  const Answer answer = run("merge some.db a.db c.db");
  EXPECT_EQ(answer.code, 0);
  EXPECT_THAT(answer.out, HasSubstr("fuzz: shards 1 of 3 are missing"));
  EXPECT_EQ(timeless_report("some.db")["runs"][0]["missing"], "shards 1 of 3 are missing");
  expect_refused("merge new.db a.db c.db a.db", {"a.db and a.db: both have shard 0/3 of the run with"});
}

TEST_F(Resume, TheCommandInAReportGivesTheSameAgain) {
  EXPECT_EQ(run("fuzz --time 1s --seed 9 --subject basic,wang --sweep needle --steps 3 --db timed.db").code,
            1);
  const json report = timeless_report("timed.db");
  const std::string again = report["runs"][0]["again"];
  ASSERT_EQ(again.rfind("nearmiss ", 0), 0);
  EXPECT_EQ(run(again.substr(9) + " --db again.db").code, 1);
  json other = timeless_report("again.db");
  other["runs"] = report["runs"];  // a number of cases, and not a time
  EXPECT_EQ(other, report);
}

TEST_F(Resume, TimeThatIsSpentIsNotHadAgain) {
  EXPECT_EQ(run("fuzz --time 1s --db a.db").code, 0);
  const json report = timeless_report("a.db");
  EXPECT_EQ(run("fuzz --time 1s --db a.db --resume").code, 0);
  EXPECT_EQ(timeless_report("a.db"), report);
}

TEST_F(Resume, OneProcessWritesAStore) {
  const pid_t child = fork();
  if (child == 0) {
    const std::string command = "cd " + file("").string() + " && exec " + NEARMISS_EXECUTABLE +
                                " fuzz --time 60s --db a.db >/dev/null 2>&1";
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  while (!std::filesystem::exists(file("a.db-wal"))) usleep(1000);
  usleep(100000);
  expect_refused("fuzz --time 1s --db a.db --resume", {"a.db: another process is writing it"});
  kill(child, SIGTERM);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_EQ(run("fuzz --time 1s --db a.db --resume").code, 0);
}

}  // namespace
}  // namespace nearmiss
