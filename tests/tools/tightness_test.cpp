// The values of a plug-in's option, as a user compares them.
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::CommandLine;
using ::testing::HasSubstr;

class OptionValues : public CommandLine {
 protected:
  const std::string tightness = "tightness --family uniform --json new.json -q --subject ";
  const std::string sampling = plugin("sampling") + ":tolerance='*'";
};

TEST_F(OptionValues, AreAskedTheSameQueries) {
  const Output output = run(tightness + "exact," + sampling + " --values 0,0.01,1 --cases 400");
  EXPECT_EQ(output.code, 1);
  EXPECT_THAT(output.out, HasSubstr("\nsampling:tolerance=*\n"));
  const json all = read_json("new.json");
  EXPECT_EQ(all["subjects"].size(), 4);
  const json steps = all["option_sweeps"]["sampling:tolerance=*"];
  ASSERT_EQ(steps.size(), 3);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(steps[i]["value"], (std::array{0.0, 0.01, 1.0})[i]);
    EXPECT_EQ(steps[i]["queries"], 400);
    EXPECT_EQ(steps[i]["collisions"], steps[0]["collisions"]);
  }
  EXPECT_EQ(steps[0]["false_negatives"], steps[0]["collisions"]);  // no sample has a distance of exactly 0
  EXPECT_LT(steps[1]["false_negatives"], steps[0]["false_negatives"]);
  EXPECT_EQ(steps[2]["false_negatives"], 0);
  EXPECT_EQ(steps[0]["false_positives"], 0);
  EXPECT_GT(steps[2]["false_positives"], steps[1]["false_positives"]);
}

TEST_F(OptionValues, AreSearchedOneByOne) {
  EXPECT_LE(run(tightness + sampling + " --values 0.01,0.1 --search --cases 132").code, 1);
  const json families = read_json("new.json")["subjects"]["sampling:tolerance=0.1"]["ee"]["families"];
  for (const char* searched : {"search-late-sampling:tolerance=0.01", "search-early-sampling:tolerance=0.1"})
    EXPECT_TRUE(families.contains(searched)) << searched;
}

TEST_F(OptionValues, ARunIsRepeatedByACampaign) {
  EXPECT_EQ(run(tightness + sampling + " --values 0,0.01 --cases 200 --seed 5 --db a.db").code, 1);
  const std::string again = read_json("new.json")["runs"][0]["again"];
  EXPECT_THAT(again, HasSubstr(":tolerance=0,"));
  EXPECT_EQ(run(again.substr(again.find(' ') + 1) + " --json again.json").code, 1);
  EXPECT_EQ(read_json("again.json")["signatures"], read_json("new.json")["signatures"]);
  EXPECT_EQ(run("report a.db -o report").code, 1);
  EXPECT_EQ(read_json("report/report.json")["option_sweeps"].size(), 1);
}

TEST_F(OptionValues, AreRefusedWithoutAnOptionToTakeThem) {
  expect_refused(tightness + "wang", {"--values"});
  expect_refused("tightness --values 1,2 --json new.json", {"--subject"});
  expect_refused("tightness --cases 100 --json new.json", {"--values"});
  expect_refused(tightness + "exact --values 1,2", {"found 'exact', expected NAME:KEY=*"});
  expect_refused(tightness + sampling + " --values 1,2 --tolerance D2", {"--tolerance"});
  expect_refused(tightness + sampling + " --values 1,-1", {"tolerance=LENGTH"});
  expect_refused(tightness + sampling + " --values 1,2 --separation 0.1", {"answers for contact only"});
  expect_refused(tightness + sampling + " --values 1,1", {"two subjects named 'sampling:tolerance=1'"});
}

}  // namespace
}  // namespace nearmiss
