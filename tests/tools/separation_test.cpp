// The command line with queries that have a separation, and with times of impact.
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;

class SeparationOption : public testing::CommandLine {
 protected:
  /// The vertex of `hit` comes within 1/2 of the triangle at t = 1/4; that of `miss` never does.
  void SetUp() override { write("q.vt", hit + miss); }

  /// A query with its separation as the 25th number.
  static std::string with(const std::string& query, const std::string& separation) {
    return query.substr(0, query.size() - 1) + " " + separation + "\n";
  }

  /// A subject that reports every pair, and promises that nothing happens before t = 1/2.
  const std::string promises = " --subject " + plugin("promises");
};

TEST_F(SeparationOption, OracleSaysWhenTheDistanceFallsToIt) {
  const std::string expected = "1 0x1p-2 0x1p-2\n0 inf inf\n";
  EXPECT_EQ(run("oracle --kind vt --toi --separation 0.5 q.vt").out, expected);
  EXPECT_EQ(run("oracle --kind vt --toi --separation 0x1p-1 --method all q.vt").out, expected);
  EXPECT_EQ(run("oracle --kind vt --rational --separation 0.5 q.vt").out,
            "1 0x1p-2 0x1p-2 1/4\n0 inf inf -\n");
  write("own.vt", with(hit, "0.5") + with(miss, "0.5"));
  EXPECT_EQ(run("oracle --kind vt --toi own.vt").out, expected);
  EXPECT_EQ(run("oracle --kind vt --toi --separation 0 own.vt").out, run("oracle --kind vt --toi q.vt").out);
}

TEST_F(SeparationOption, OracleSaysYesToADistanceOfExactlyIt) {
  write("tie.vt", miss);  // its distance falls from 2 to 1
  for (const char* method : {"filtered", "exact", "certificate", "all"})
    EXPECT_EQ(run(std::string("oracle --kind vt --toi --separation 1 tie.vt --method ") + method).out,
              "1 0x1p+0 0x1p+0\n")
        << method;
  EXPECT_EQ(run("oracle --kind vt --separation 0x1.fffffffffffffp-1 tie.vt").out, "0\n");
}

TEST_F(SeparationOption, VerdictPrintsTheTime) {
  EXPECT_THAT(run("verdict --kind vt --subject exact --separation 0.5 q.vt").out,
              MatchesRegex("1 [a-z]+ 0x1p-2\n0\n"));
  EXPECT_EQ(run("verdict --kind vt --separation 0.5 q.vt" + promises).out,
            "1 unspecified 0x1p-1\n1 unspecified 0x1p-1\n");
}

TEST_F(SeparationOption, IsRefusedIfItIsNoDistanceOrIfASubjectTakesNone) {
  write("one.vt", hit);
  for (const std::string command :
       {"oracle --kind vt q.vt", "verdict --kind vt --subject exact q.vt", "bench q.vt --subject exact",
        "replay q.vt", "shrink one.vt --subject exact", "fuzz --cases 10 --subject exact"})
    for (const char* other : {"-1", "nan", "inf", "x", "0.5,1"})
      expect_refused(command + " --separation=" + other, {"--separation", other});
  for (const std::string command : {"verdict --kind vt q.vt", "bench q.vt --json new.json", "shrink one.vt",
                                    "fuzz --cases 10 --kind vt --db new.db", "replay q.vt --db new.db"})
    expect_refused(command + " --subject wang --separation 0.5", {"wang: answers for contact only"});
  write("own.vt", hit + with(hit, "0.5"));
  expect_refused("bench own.vt --subject exact,wang", {"wang: answers for contact only"});
  expect_refused("verdict --kind vt --subject wang own.vt", {"wang: answers for contact only"});
}

TEST_F(SeparationOption, ReplaySaysWhoIsNotAsked) {
  write("own.vt", hit + with(hit, "0.5"));
  EXPECT_THAT(
      run("replay own.vt --subject exact,wang").out,
      HasSubstr("wang: not asked about 1 case with a separation, because it answers for contact only\n"));
  EXPECT_THAT(run("replay own.vt --subject exact").out, Not(HasSubstr("not asked")));
  EXPECT_THAT(run("replay own.vt --separation 0 --subject wang").out, Not(HasSubstr("not asked")));
}

TEST_F(SeparationOption, BenchTimesQueriesWithIt) {
  const std::string options = "bench q.vt --subject exact --queries 5 --runs 1 --json b.json";
  EXPECT_EQ(run(options + " --separation 1.5").code, 0);
  const json results = read_json("b.json")["results"];
  ASSERT_EQ(results.size(), 7);
  EXPECT_EQ(results[0]["input"], "q.vt~1.5");
  EXPECT_EQ(results[0]["queries"], 2);  // boxes meet if they are at most 1.5 apart
  EXPECT_EQ(results[1]["input"], "uniform~1.5");
  EXPECT_EQ(run(options).code, 0);
  EXPECT_EQ(read_json("b.json")["results"][0]["input"], "q.vt");
  EXPECT_EQ(read_json("b.json")["results"][0]["queries"], 1);
}

TEST_F(SeparationOption, ZeroAsksForContact) {
  const auto campaign = [&](const std::string& option) {
    const std::string file = "c" + std::to_string(option.size()) + ".json";
    EXPECT_EQ(run("fuzz --subject wang --family uniform --cases 100 --json " + file + option).code, 0);
    return read_json(file)["subjects"]["wang"]["vt"]["collisions"];
  };
  EXPECT_EQ(campaign(" --separation 0"), campaign(""));
  EXPECT_EQ(campaign(" --separation 0x0p+0"), campaign(""));
}

TEST_F(SeparationOption, ShrinkKeepsALateTime) {
  write("one.vt", hit);
  EXPECT_EQ(run("shrink one.vt" + promises).code, 2);  // contact begins at t = 1/2, so this time is not late
  expect_code(0, "shrink one.vt -o late.case --separation 0.5" + promises);
  EXPECT_THAT(read("late.case"), HasSubstr("# late of always: vt "));
  const Output again = expect_code(1, "replay late.case --json r.json" + promises);
  EXPECT_THAT(again.out, HasSubstr("FAIL always: no miss in 1 collision; LATE vt 1 of 1;"));
  const json counts = read_json("r.json")["subjects"]["always"]["vt"];
  EXPECT_EQ(counts["late"], 1);
  EXPECT_EQ(counts["times_promised"], 1);
  EXPECT_EQ(counts["time_sort"], "lower-bound");
}

TEST_F(SeparationOption, AReportSaysThatOfEachRun) {
  for (const char* each : {"0.25", "drawn"})
    EXPECT_EQ(run(std::string("fuzz --family uniform --cases 40 --subject exact --db ") + each +
                  ".db --separation " + each)
                  .code,
              0);
  EXPECT_EQ(run("report 0.25.db drawn.db -o report").code, 0);
  const json report = read_json("report/report.json");
  std::vector<std::string> separations;
  for (const json& each : report["runs"]) separations.push_back(each["separation"].get<std::string>());
  EXPECT_THAT(separations, ::testing::UnorderedElementsAre("0.25", "drawn"));
  const json& families = report["subjects"]["exact"]["vt"]["families"];
  EXPECT_TRUE(families.contains("uniform~0.25") && families.contains("uniform~drawn"));
}

}  // namespace
}  // namespace nearmiss
