// Exit codes depend on the results that a subcommand shows, in the same way for every subcommand.
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using testing::CommandLine;
using ::testing::HasSubstr;

TEST_F(CommandLine, AMissGivesExitCodeOne) {
  EXPECT_THAT(expect_code(1, "replay hit.vt --subject " + plugin("never")).out,
              HasSubstr(": MISSED the collision\n"));
}

/// A subject, and the exit code with which every subcommand shows its results.
struct Shown {
  const char* what;
  const char* subject;  ///< a plug-in with options, or a built-in subject
  int code;
  const char* fails_on = "";  ///< a value of --fail-on with which the code is 1
  const char* environment = "NEARMISS_ONE_IN=10";
  const char* options = "";
  bool only_replayed = false;
};

class ExitCodes : public CommandLine, public ::testing::WithParamInterface<Shown> {
 protected:
  /// Writes queries. Most plug-ins that misbehave answer only some of them.
  void SetUp() override {
    const std::string late = "0.95 0.01 1  0 0 0  1 0 0  0 1 0   0.95 0.01 -2  0 0 0  1 0 0  0 1 0\n";
    ASSERT_EQ(run("family uniform --kind vt --count 40").code, 0);
    write("q.vt", hit + miss + late + read("out.txt"));
  }

  /// Runs a command that stores its results in a.db, and all commands that show these results. Expects the
  /// exit code of GetParam() from each.
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
                      Shown{"some_slow", "sleep.so", 0, "slow", "NEARMISS_ONE_IN=10", "--query-time 30ms"},
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
