// Exit codes depend on what is shown, in the same way for every subcommand.
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using testing::CommandLine;
using ::testing::HasSubstr;

TEST_F(CommandLine, AMissGivesExitCodeOne) {
  write("q.vt", hit);
  const Output output = run("replay q.vt --subject " + plugin("never"));
  EXPECT_EQ(output.code, 1);
  EXPECT_THAT(output.out, HasSubstr("MISSED 1 of 1 collision"));
  EXPECT_THAT(output.out, HasSubstr("q.vt:1"));
}

TEST_F(CommandLine, AMissGivesExitCodeOneWhereverItIsShown) {
  write("q.vt", hit);
  EXPECT_EQ(run("replay q.vt --db a.db --subject " + plugin("never")).code, 1);
  EXPECT_EQ(run("merge b.db a.db").code, 1);
  EXPECT_EQ(run("report b.db -o report").code, 1);
  EXPECT_EQ(run("report b.db -o report --baseline a.db").code, 1);  // the baseline has the same miss
}

TEST_F(CommandLine, ARefutedBoundGivesExitCodeOneWhereverItIsShown) {
  write("q.vt", miss);
  EXPECT_EQ(run("replay q.vt --db a.db --subject " + plugin("bounded")).code, 1);
  EXPECT_EQ(run("merge b.db a.db").code, 1);
  EXPECT_EQ(run("report b.db -o report").code, 1);
}

TEST_F(CommandLine, FaultsAloneGiveExitCodeZeroWhereverTheyAreShown) {
  write("q.vt", hit);
  const Output output = run("replay q.vt --db a.db --subject " + plugin("error"));
  EXPECT_EQ(output.code, 0) << output.error;
  EXPECT_THAT(output.out, HasSubstr("FAIL always: no miss in 0 collisions, NO ANSWER to 1 query (1 error)"));
  EXPECT_EQ(run("merge b.db a.db").code, 0);
  EXPECT_EQ(run("report b.db -o report").code, 0);
  EXPECT_EQ(run("replay q.vt --db wang.db").code, 0);
  for (const char* baseline : {"a.db", "wang.db"})
    EXPECT_EQ(run(std::string("report b.db -o report --baseline ") + baseline).code, 0) << baseline;
}

TEST_F(CommandLine, AWrongRecordedTruthGivesExitCodeOne) {
  write("a.case",
        "# deliberately wrong\nkind vt\ntruth 0\nx0 0.25 0.25 1\nx1 0 0 0\nx2 1 0 0\nx3 0 1 0\n"
        "y0 0.25 0.25 -1\ny1 0 0 0\ny2 1 0 0\ny3 0 1 0\n");
  const Output output = run("replay a.case --json new.json");
  EXPECT_EQ(output.code, 1);
  EXPECT_EQ(read_json("new.json")["oracle"]["mismatches_with_recorded_truth"], 1);
}

}  // namespace
}  // namespace nearmiss
