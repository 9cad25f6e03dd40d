// Contracts of plug-ins, on the command line.
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using testing::CommandLine;
using ::testing::HasSubstr;

/// The counter of this name, or 0 if the counts do not have it.
std::uint64_t count(const nlohmann::json& counts, const std::string& name) { return counts.value(name, 0U); }

TEST_F(CommandLine, QueriesBeyondAContractAreNotAskedOrCountedApart) {
  const std::string fuzz =
      "fuzz --family small-integer --cases 2000 --subject " + plugin("several") + ":narrow-apart --json ";
  EXPECT_EQ(run(fuzz + "a.json").code, 1);
  const auto alone = read_json("a.json");
  EXPECT_EQ(alone["subjects"].size(), 1U);
  const Output both = expect_code(1, fuzz + "b.json --beyond-contract");
  EXPECT_THAT(both.out, HasSubstr("narrow-apart (beyond contract)"));
  const auto apart = read_json("b.json");
  for (const char* kind : {"vt", "ee"}) {
    const auto& keeping = alone["subjects"]["narrow-apart"][kind];
    EXPECT_EQ(count(keeping, "collisions"), count(apart["subjects"]["narrow-apart"][kind], "collisions"));
    const auto& beyond = apart["subjects"]["narrow-apart (beyond contract)"][kind];
    EXPECT_GT(count(keeping["faults"], "contract"), 0U);
    EXPECT_EQ(count(keeping["faults"], "contract") + count(beyond["faults"], "contract"),
              count(keeping, "queries"));
    // Contact at the start is always a collision, and this plug-in misses all of them.
    EXPECT_EQ(count(beyond, "false_negatives"), count(keeping["faults"], "contract"));
  }
}

// The plug-in misses everything, but its contract requires edges that are at least 1e300 long.
TEST_F(CommandLine, MissesBeyondAContractDoNotCount) {
  const Output factors = expect_code(0, "family crossed --count 1000 --missed-by " + plugin("never_asked"));
  EXPECT_EQ(factors.out, "");
  EXPECT_EQ(run("power --way uniform --time 1s --json a.json --subject " + plugin("never_asked")).code, 0);
  EXPECT_TRUE(read_json("a.json")[0]["failure"].is_null());
}

// Root parity misses contact with an even number of roots, about which it promises nothing.
TEST_F(CommandLine, FailuresBeyondAContractAreShownButNeverCount) {
  const std::string fuzz = "fuzz --family small-integer --cases 4000 --subject parity --beyond-contract";
  expect_code(0, fuzz + " --seed 2 --db before.db");
  const Output asked = expect_code(0, fuzz + " --db a.db");
  EXPECT_THAT(asked.out, HasSubstr(" ok  parity: no miss in "));
  EXPECT_THAT(asked.out, HasSubstr(" --  parity (beyond contract): MISSED "));
  for (const std::string with : {"", " --baseline before.db", " --fail-on unknown,slow"}) {
    expect_code(0, "report a.db -o report" + with);
    const auto report = read_json("report/report.json");
    EXPECT_TRUE(report["headline"]["clean"]) << with;
    EXPECT_TRUE(report["headline"]["alarms"].empty()) << with;
    const auto& beyond = report["verdicts"][1];
    EXPECT_EQ(beyond["subject"], "parity (beyond contract)");
    EXPECT_TRUE(beyond["beyond_contract"]);
    EXPECT_EQ(beyond["failures"], nlohmann::json{"miss"});
    const std::string replays = report["findings"].at(beyond["finding"].get<std::size_t>())["again"];
    EXPECT_THAT(replays, ::testing::EndsWith(" --subject parity --beyond-contract"));
    ASSERT_THAT(replays, ::testing::StartsWith("nearmiss replay cases/"));
    const Output replayed = run("replay report/" + replays.substr(replays.find("cases/")));
    EXPECT_THAT(replayed.out, HasSubstr("parity (beyond contract): MISSED "));
    EXPECT_FALSE(report["error_against_time"]["subjects"].contains("parity (beyond contract)"));
  }
}

TEST_F(CommandLine, AResumeAsksTheSameSideOfAContract) {
  const std::string fuzz =
      "fuzz --family small-integer --subject " + plugin("several") + ":narrow-apart --db a.db";
  EXPECT_EQ(run(fuzz + " --cases 200").code, 1);
  expect_refused(fuzz + " --cases 200 --resume --beyond-contract", {"beyond contract"});
}

}  // namespace
}  // namespace nearmiss
