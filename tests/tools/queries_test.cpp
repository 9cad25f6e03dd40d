// Tests the commands that print queries, and the bounds by which subjects are judged, as a user runs them.
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::CommandLine;
using ::testing::MatchesRegex;

TEST_F(CommandLine, VerdictPrintsTheDistanceBoundAndWhoseItIs) {
  write("q.vt", hit + miss);
  const std::string wangs = run("verdict --kind vt --subject wang --distance-bound q.vt").out;
  EXPECT_THAT(wangs, MatchesRegex("1 proximity 0x1p-1 0x[^ ]* claimed\n0 0x[^ ]* claimed\n"));
  // basic claims no bound, so its distances are measured by wang's bound.
  std::string expected = wangs;
  for (auto at = expected.find("claimed"); at != std::string::npos; at = expected.find("claimed"))
    expected.replace(at, 7, "wang");
  EXPECT_EQ(run("verdict --kind vt --subject basic --distance-bound q.vt").out, expected);
}

TEST_F(CommandLine, VerdictPrintsTheQueryAsTheSubjectRoundsIt) {
  const std::string fine = "0x1.0000001p+0 0x1p+0 0x1p+1";
  const std::string triangle = " 0x0p+0 0x0p+0 0x0p+0 0x1p+0 0x0p+0 0x0p+0 0x0p+0 0x1p+0 0x0p+0";
  const std::string end = " 0x1p+0 0x1p+0 0x1p+0" + triangle + "\n";
  write("q.vt", fine + triangle + end);
  EXPECT_EQ(run("verdict --kind vt --subject wang --rounded q.vt").out, "0 " + fine + triangle + end);
  EXPECT_EQ(run("verdict --kind vt --subject wang:float --rounded q.vt").out,
            "0 0x1p+0 0x1p+0 0x1p+1" + triangle + end);
}

TEST_F(CommandLine, FamilyPrintsTheQueriesOfACampaign) {
  const auto lines = [&](const std::string& options) {
    const Output output = expect_code(0, "family parallel --seed 5 " + options);
    return output.out;
  };
  const auto count = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
  for (const char* kind : {"--kind vt ", "--kind ee "}) {
    const std::string of_kind = kind;
    EXPECT_EQ(count(lines(of_kind + "--first 2 --count 5")), 5);
    EXPECT_EQ(lines(of_kind + "--count 8"),
              lines(of_kind + "--count 4") + lines(of_kind + "--first 8 --count 4"));
  }
  // The printed queries are those of a campaign, and give the same counts.
  EXPECT_EQ(run("fuzz --family parallel --seed 5 --cases 1000 --json fuzz.json").code, 0);
  write("q.ee", lines("--kind ee --count 500"));
  EXPECT_EQ(run("replay q.ee --json replay.json").code, 0);
  const json campaign = read_json("fuzz.json")["subjects"]["wang"]["ee"];
  const json replay = read_json("replay.json")["subjects"]["wang"]["ee"];
  for (const char* each : {"queries", "collisions", "positives", "false_positives"})
    EXPECT_EQ(replay[each], campaign[each]) << each;
  ASSERT_FALSE(campaign["farthest"].empty());
  EXPECT_EQ(replay["farthest"][0]["query"], campaign["farthest"][0]["query"]);
}

TEST_F(CommandLine, FamilyRefusesUnknownNames) {
  expect_refused("family uniforms --kind vt --count 1", {"unknown family 'uniforms'", "uniform-end"});
  expect_refused("family all --kind vt --count 1", {"unknown family 'all'"});
  expect_refused("family needle@5 --kind vt --count 1", {"'needle@5'", "from -16 to 0"});
  expect_refused("family uniform --count 1", {"--kind is required"});
  expect_refused("family uniform --kind vf --count 1", {"--kind", "vf"});
  expect_refused("family uniform --kind vt", {"--count is required"});
  expect_refused("family uniform --kind vt --count 0", {"--count"});
  expect_refused("family uniform --kind vt --count 1 --first=-1", {"--first"});
  expect_refused("family uniform --kind vt --count 1 --seed x", {"--seed"});
  expect_refused("family --kind vt --count 1", {"NAME is required"});
}

TEST_F(CommandLine, FamilyRefusesFactorsOfOtherFamilies) {
  for (const char* option : {"--coverage", "--missed-by wang", "--kind vt --factors"})
    expect_refused(std::string("family uniform --count 1 ") + option, {"'uniform'", "crossed"});
  expect_refused("family crossed --count 1 --coverage --kind vt", {"--coverage", "--kind"});
  expect_refused("family crossed --count 1 --factors", {"--factors", "--kind"});
}

TEST_F(CommandLine, FamilyShowsTheFactorsOfCrossedQueries) {
  EXPECT_THAT(run("family crossed --kind ee --factors --count 1").out,
              MatchesRegex("shape=[a-z-]+ motion=[a-z]+ when=[a-z0-9-]+ .*offset=[a-z]+\n"));
  const std::string coverage = run("family crossed --coverage --count 1").out;
  EXPECT_THAT(coverage, ::testing::HasSubstr("not made: motion=rest when=at-1\n"));
  EXPECT_THAT(coverage, ::testing::HasSubstr("pairs: 21 of the 604 that are made occur in 1 query\n"));
  EXPECT_THAT(coverage, ::testing::HasSubstr("triples: 35 of the 4,885 that are made occur in 1 query\n"));
  const std::string missed = run("family crossed --missed-by basic --count 4000").out;
  EXPECT_THAT(missed, ::testing::HasSubstr("basic vt: "));
  EXPECT_THAT(missed, ::testing::HasSubstr(" % of the missed ones have "));
  EXPECT_THAT(run("family crossed --missed-by exact --count 100").out,
              ::testing::HasSubstr("exact vt: 0 of "));
}

}  // namespace
}  // namespace nearmiss
