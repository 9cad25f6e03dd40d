// Recordings of simulations: what nearmiss_record.h writes, nearmiss judges.
#include <filesystem>
#include <fstream>

#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using testing::CommandLine;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

class Recording : public CommandLine {
 protected:
  /// Runs the recording program, and returns its exit code.
  [[nodiscard]] int record(const std::string& arguments,
                           const std::string& settings = "NEARMISS_RECORD=run.nmq") const {
    const std::string command = "cd " + file("").string() + " && " + settings +
                                " " NEARMISS_PLUGINS "/recording " + arguments + " 2>recorder.txt";
    return std::system(command.c_str());
  }

  /// The counters of the recorded answers.
  [[nodiscard]] nlohmann::json judged(int code, const std::string& files = "run.nmq") const {
    expect_code(code, "replay " + files + " --as-answered --json new.json");
    return read_json("new.json")["subjects"]["recorded"]["vt"];
  }
};

TEST_F(Recording, IsJudgedAsTheSimulationWasAnswered) {
  ASSERT_EQ(record("100"), 0);
  const auto counts = judged(1);
  EXPECT_EQ(counts["queries"], 100);
  EXPECT_EQ(counts["false_negatives"], 10);
  EXPECT_EQ(counts["times_given"], 90);
  EXPECT_EQ(counts["late"], 0);
  EXPECT_NEAR(counts["max_early"], 0.25, 1e-9);  // contact is at t = 1/2
  const Output output = run("replay run.nmq --as-answered");
  EXPECT_THAT(output.out, HasSubstr("FAIL recorded: MISSED"));
  EXPECT_THAT(output.out, HasSubstr("false-negative recorded run.nmq:"));
  // Any CCD can be asked the same queries, and one that missed them has its findings shrunk.
  EXPECT_THAT(expect_code(0, "replay run.nmq --subject wang").out, HasSubstr("no miss in 100 collisions"));
}

TEST_F(Recording, NothingIsWrittenUnlessTheUserAsks) {
  ASSERT_EQ(record("100", ""), 0);
  ASSERT_EQ(record("100", "NEARMISS_RECORD="), 0);
  EXPECT_EQ(read("recorder.txt"), "");
  EXPECT_FALSE(fs::exists(file("run.nmq")));
}

TEST_F(Recording, HasTheLatestQueriesAndThoseThatAreKept) {
  ASSERT_EQ(record("1000 kept", "NEARMISS_RECORD=run.nmq NEARMISS_RECORD_BYTES=20480"), 0);
  EXPECT_EQ(fs::file_size(file("run.nmq")), 4096 + 20480);
  const Output output = run("replay run.nmq --as-answered --json -");
  EXPECT_THAT(output.error, Not(HasSubstr("left out")));
  const auto counts = nlohmann::json::parse(output.out)["subjects"]["recorded"]["vt"];
  EXPECT_EQ(counts["queries"], 60 + 1);  // a quarter of the 80 records is for those that are kept
  EXPECT_EQ(counts["false_negatives"], 6);
  expect_code(0, "convert run.nmq -o converted");
  EXPECT_THAT(read("converted/queries.vt"),
              HasSubstr("\n0x1.00003e8p-2 "));  // the last query: 1/4 + 1000/2^30
}

TEST_F(Recording, OfAProgramThatIsKilledIsWhole) {
  EXPECT_NE(record("64 kill"), 0);
  EXPECT_EQ(judged(1)["queries"], 64);
}

TEST_F(Recording, OfManyThreadsHasEveryQuery) {
  ASSERT_EQ(record("5000 threads"), 0);
  const auto counts = judged(1);
  EXPECT_EQ(counts["queries"], 20'000);
  EXPECT_EQ(counts["false_negatives"], 2000);
}

TEST_F(Recording, OfAForkHasBothProcesses) {
  ASSERT_EQ(record("100 fork"), 0);
  for (int wait = 0; wait < 100 && judged(1)["queries"] < 201; ++wait) ::usleep(50'000);
  EXPECT_EQ(judged(1)["queries"], 201);
  EXPECT_EQ(std::distance(fs::directory_iterator(file("")), fs::directory_iterator()), 5);  // one recording
}

TEST_F(Recording, OfASecondProcessIsAnotherFile) {
  ASSERT_EQ(std::system(
                ("cd " + file("").string() +
                 " && (NEARMISS_RECORD=run.nmq " NEARMISS_PLUGINS
                 "/recording 20 wait & echo $! >first); sleep 0.5; NEARMISS_RECORD=run.nmq " NEARMISS_PLUGINS
                 "/recording 30; kill -9 $(cat first); ls *.nmq >names")
                    .c_str()),
            0);
  std::string second;
  for (const auto& each : fs::directory_iterator(file("")))
    if (const auto name = each.path().filename().string(); name.starts_with("run-")) second = name;
  ASSERT_NE(second, "") << read("names");
  EXPECT_EQ(judged(1)["queries"], 20);
  EXPECT_EQ(judged(1, second)["queries"], 30);
}

TEST_F(Recording, AnEarlierOneIsKeptOnce) {
  ASSERT_EQ(record("20"), 0);
  ASSERT_EQ(record("30"), 0);
  EXPECT_EQ(judged(1)["queries"], 30);
  fs::rename(file("run.nmq~"), file("earlier.nmq"));
  EXPECT_EQ(judged(1, "earlier.nmq")["queries"], 20);
}

TEST_F(Recording, ThatIsCutInMidRecordHasTheRest) {
  ASSERT_EQ(record("100", "NEARMISS_RECORD=run.nmq NEARMISS_RECORD_BYTES=65536"), 0);
  fs::resize_file(file("run.nmq"), 4096 + 256 * 50 + 100);
  const Output output = run("replay run.nmq --as-answered --json new.json");
  EXPECT_THAT(
      output.error,
      HasSubstr("run.nmq: 50 records left out: they were being written when the program or the file ended"));
  EXPECT_EQ(read_json("new.json")["subjects"]["recorded"]["vt"]["queries"], 50);
  // A record with a changed byte is not judged, either.
  std::fstream(file("run.nmq"), std::ios::in | std::ios::out | std::ios::binary)
      .seekp(4096 + 256 * 4 + 80)
      .put('x');
  EXPECT_EQ(judged(1)["queries"], 49);
}

TEST_F(Recording, OfAProgramInFloatIsExact) {
  ASSERT_EQ(record("1 float"), 0);
  EXPECT_EQ(judged(0)["false_negatives"], 0);
  expect_code(0, "convert run.nmq -o converted");
  EXPECT_THAT(read("converted/queries.vt"), HasSubstr("\n0x1.99999ap-4 0x1.99999ap-4 0x1p+0 "));
}

TEST_F(Recording, OfAShorterOrLongerStepIsJudgedThere) {
  // Contact is at t = 1/2: after tmax = 1/4, where the answers "no" are right, and before 3/4 and 5/4.
  ASSERT_EQ(record("20 tmax 0.25"), 0);
  auto counts = judged(0);
  EXPECT_EQ(counts["queries"], 20);
  EXPECT_EQ(counts["collisions"], 0);
  for (const char* tmax : {"0.75", "1.25"}) {
    ASSERT_EQ(record(std::string("20 tmax ") + tmax), 0);
    counts = judged(1);
    EXPECT_EQ(counts["queries"], 20) << tmax;
    EXPECT_EQ(counts["false_negatives"], 2) << tmax;
    EXPECT_EQ(counts["late"], 0) << tmax;
  }
}

TEST_F(Recording, ThatIsNoneIsRefused) {
  write("none.nmq", "no recording");
  expect_refused("replay none.nmq --as-answered", {"none.nmq", "found no recording", "nearmiss_record.h"});
  write("q.vt", hit);
  expect_refused("replay q.vt --as-answered", {"q.vt", "found no recording"});
  expect_refused("replay q.vt --as-answered --subject wang", {"--as-answered", "--subject"});
  ASSERT_EQ(record("0", "NEARMISS_RECORD=run.nmq"), 0);  // it never recorded, so there is no file
  EXPECT_FALSE(fs::exists(file("run.nmq")));
  ASSERT_EQ(record("1", "NEARMISS_RECORD=/nowhere/run.nmq"), 0);
  EXPECT_THAT(read("recorder.txt"),
              HasSubstr("nearmiss_record: /nowhere/run.nmq: No such file or directory; nothing is recorded"));
}

TEST_F(Recording, IsWhereACampaignHunts) {
  ASSERT_EQ(record("100"), 0);
  const Output output =
      expect_code(1, "fuzz --subject never=" + plugin("never") +
                         " --near run.nmq --family near --cases 400 --json new.json --db new.db");
  const auto counts = read_json("new.json")["subjects"]["never"];
  EXPECT_EQ(counts.size(), 1);  // only vertices and triangles were recorded
  EXPECT_EQ(counts["vt"]["families"]["near"]["queries"], 400);
  EXPECT_GT(counts["vt"]["families"]["near"]["false_negatives"], 100);
  EXPECT_THAT(output.out, HasSubstr("ordinary"));
  write("w.ve", "0 0 0  0 0 1  0 0 2   0 0 1  0 0 1  0 0 2   0.5\n");
  expect_code(
      0,
      "fuzz --subject wang --near run.nmq --near w.ve --family near,v-near-within --cases 400 --json n.json");
  EXPECT_EQ(read_json("n.json")["subjects"]["wang"]["ve"]["families"]["v-near-within"]["queries"], 200);
}

}  // namespace
}  // namespace nearmiss
