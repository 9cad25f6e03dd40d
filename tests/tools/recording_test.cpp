// Tests recordings of simulations: nearmiss judges the answers that nearmiss_record.h has recorded.
#include <cstdlib>
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
  /// Runs the program tests/plugin/recording.c. Returns 0 if the program ends with exit code 0.
  [[nodiscard]] int record(const std::string& arguments,
                           const std::string& settings = "NEARMISS_RECORD=run.nmq") const {
    const std::string command = "cd " + file("").string() + " && " + settings +
                                " " NEARMISS_PLUGINS "/recording " + arguments + " 2>recorder.txt";
    return std::system(command.c_str());
  }

  /// Judges recorded answers, and expects the exit code `code`. Returns the counters of the vt queries.
  [[nodiscard]] nlohmann::json judged(int code, const std::string& files = "run.nmq") const {
    return json_of(code, "replay " + files + " --as-answered")["subjects"]["recorded"]["vt"];
  }

  /// Records the answers in `lines`, which consist of lines from falling(). Judges the answers as `judged`
  /// does.
  [[nodiscard]] nlohmann::json judged_lines(int code, const std::string& lines) const {
    write("lines", lines);
    EXPECT_EQ(record("0 lines <lines"), 0);
    return judged(code);
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
  EXPECT_THAT(read("error.txt"), ::testing::AllOf(HasSubstr("FAIL recorded: MISSED"),
                                                  HasSubstr("false-negative recorded run.nmq:")));
  EXPECT_THAT(expect_code(0, "replay run.nmq --subject wang").out, HasSubstr("no miss in 100 collisions"));
}

TEST_F(Recording, HasTheLatestQueriesAndThoseThatAreKept) {
  ASSERT_EQ(record("1000 kept", "NEARMISS_RECORD=run.nmq NEARMISS_RECORD_BYTES=20480"), 0);
  EXPECT_EQ(fs::file_size(file("run.nmq")), 4096 + 20480);
  const auto counts = judged(1);
  EXPECT_THAT(read("error.txt"), Not(HasSubstr("left out")));
  EXPECT_EQ(counts["queries"], 60 + 1);  // of the room for 80 records, a quarter is only for kept queries
  EXPECT_EQ(counts["false_negatives"], 6);
  expect_code(0, "convert run.nmq -o converted");
  EXPECT_THAT(read("converted/queries.vt"),
              HasSubstr("\n0x1.00003e8p-2 "));  // a coordinate of the last query: 1/4 + 1000/2^30
}

TEST_F(Recording, OfAProgramThatIsKilledIsWhole) {
  EXPECT_NE(record("64 kill"), 0);
  EXPECT_EQ(judged(1)["queries"], 64);
}

TEST_F(Recording, OfManyThreadsHasEveryQuery) {
  ASSERT_EQ(record("1000 threads"), 0);
  const auto counts = judged(1);
  EXPECT_EQ(counts["queries"], 4000);
  EXPECT_EQ(counts["false_negatives"], 400);
}

TEST_F(Recording, OfAForkHasBothProcesses) {
  ASSERT_EQ(record("100 fork"), 0);
  for (int wait = 0; wait < 100 && judged(1)["queries"] < 201; ++wait) ::usleep(50'000);
  EXPECT_EQ(judged(1)["queries"], 201);
  EXPECT_EQ(std::distance(fs::directory_iterator(file("")), fs::directory_iterator()), 6);  // one recording
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
  EXPECT_EQ(judged(1)["queries"], 50);
  EXPECT_THAT(
      read("error.txt"),
      HasSubstr("run.nmq: 50 records left out: they were being written when the program or the file ended"));
  std::fstream(file("run.nmq"), std::ios::in | std::ios::out | std::ios::binary)
      .seekp(4096 + 256 * 4 + 80)
      .put('x');
  EXPECT_EQ(judged(1)["queries"], 49);
}

TEST_F(Recording, OfAShorterOrLongerStepIsJudgedThere) {
  // The first contact is at t = 1/2. If tmax is 1/4, the step ends before the contact, so the answers "no"
  // are right. If tmax is 3/4 or 5/4, these answers are misses.
  ASSERT_EQ(record("20 tmax 0.25"), 0);
  auto counts = judged(0);
  EXPECT_EQ(counts["queries"], 20);
  EXPECT_EQ(counts["false_negatives"], 0);
  EXPECT_EQ(counts["collisions"], 18);  // an answer with a time is judged for the whole step
  for (const char* tmax : {"0.75", "1.25"}) {
    ASSERT_EQ(record(std::string("20 tmax ") + tmax), 0);
    counts = judged(1);
    EXPECT_EQ(counts["queries"], 20) << tmax;
    EXPECT_EQ(counts["false_negatives"], 2) << tmax;
    EXPECT_EQ(counts["late"], 0) << tmax;
  }
}

/// A line that makes the program record a query and its answer: a vertex moves from z0 to z1 over a triangle
/// at z = 0.
std::string falling(const std::string& z0, const std::string& z1, const std::string& tmax, int answer,
                    const std::string& toi, int in_float = 0, const std::string& h = "0") {
  return "1 " + h + " " + tmax + " " + std::to_string(answer) + " " + toi + " " + std::to_string(in_float) +
         "  0.25 0.25 " + z0 + " 0 0 0 1 0 0 0 1 0  0.25 0.25 " + z1 + " 0 0 0 1 0 0 0 1 0\n";
}

TEST_F(Recording, EachAnswerToTheSameQueryIsJudged) {
  // The program asks a query again with a shorter step (tmax), as a line search does. Some answers have no
  // time.
  const auto counts =
      judged_lines(1, falling("1.1", "-1.2", "0.7", 1, "0.3") + falling("1.1", "-1.2", "0.61", 1, "0.55") +
                          falling("1.1", "-1.2", "0.61", 1, "0.55") + falling("1", "0.5", "0.3", 1, "nan") +
                          falling("1", "0.5", "1", 0, "nan"));
  EXPECT_EQ(counts["queries"], 5);
  EXPECT_EQ(counts["late"], 2);
  EXPECT_EQ(counts["false_positives"], 1);
  EXPECT_EQ(counts["false_negatives"], 0);
  EXPECT_TRUE(counts["faults"].empty());
}

TEST_F(Recording, ATimeIsLateByOneUlpWhateverTmaxIs) {
  // Contact is at t = 1/2, exactly.
  for (const std::string tmax : {"1", "0.61", "0x1.8p-1"})
    EXPECT_EQ(
        judged_lines(1, falling("1", "-1", tmax, 1, "0x1.0000000000001p-1") +
                            falling("1", "-1", tmax, 1, "0.5") + falling("1", "-1", tmax, 1, "nan"))["late"],
        1)
        << tmax;
}

TEST_F(Recording, StepsOfAProgramInFloatAreTakenInFloat) {
  // In float, a vertex that moves from 1 to -9 is just below the plane at t = 0.1F: 1 - 0.1F * 10 < 0.
  const auto in_float = judged_lines(1, falling("1", "-9", "1", 1, "0x1.99999ap-4", 1));
  EXPECT_EQ(
      in_float["late"].get<int>() + in_float["committed"].get<int>() + in_float["touch_at_end"].get<int>(),
      1);
  EXPECT_EQ(judged_lines(0, falling("1", "-9", "1", 1, "0x1.9999999999999p-4"))["late"], 0);
}

TEST_F(Recording, NumbersThatFitNoRecordAreInvalid) {
  const auto counts =
      judged_lines(1, falling("1", "-1", "1", 256, "nan") + falling("1", "-1", "1", 1, "0.25"));
  EXPECT_EQ(counts["false_negatives"], 0);
  EXPECT_EQ(counts["faults"]["error"], 1);
}

TEST_F(Recording, HarmsNoOtherFile) {
  for (const char* not_asked : {"", "NEARMISS_RECORD="}) EXPECT_EQ(record("100", not_asked), 0);
  EXPECT_EQ(read("recorder.txt"), "");
  EXPECT_FALSE(fs::exists(file("run.nmq")));
  ASSERT_EQ(std::system(("mkfifo " + file("fifo").string()).c_str()), 0);
  ASSERT_EQ(record("1", "NEARMISS_RECORD=fifo"), 0);
  EXPECT_THAT(read("recorder.txt"), HasSubstr("fifo: no regular file; nothing is recorded"));
  EXPECT_TRUE(fs::is_fifo(file("fifo")));
  for (const char* bytes : {"-1", "64X", "99999999999999999999999", "100"}) {
    ASSERT_EQ(record("1", std::string("NEARMISS_RECORD=run.nmq NEARMISS_RECORD_BYTES=") + bytes), 0) << bytes;
    EXPECT_THAT(read("recorder.txt"), HasSubstr("the size is not between 16 KiB and 1 TiB")) << bytes;
  }
  ASSERT_EQ(record("1", "ulimit -f 100; NEARMISS_RECORD=run.nmq"), 0);
  EXPECT_THAT(read("recorder.txt"), HasSubstr("File too large; nothing is recorded"));
  EXPECT_FALSE(fs::exists(file("run.nmq")));
  ASSERT_EQ(record("1", "NEARMISS_RECORD=run.nmq NEARMISS_RECORD_BYTES=64K"), 0);
  EXPECT_EQ(fs::file_size(file("run.nmq")), 4096 + 65536);
}

TEST_F(Recording, ACampaignAroundOtherQueriesIsAnotherOne) {
  ASSERT_EQ(record("100"), 0);
  const std::string command =
      "fuzz --subject wang --near run.nmq --family near --cases 400 --db a.db --quiet";
  expect_code(0, command);
  ASSERT_EQ(record("200"), 0);
  EXPECT_EQ(run(command + " --resume").code, 2);
}

TEST_F(Recording, ThatIsNoneIsRefused) {
  write("none.nmq", "no recording");
  expect_refused("replay none.nmq --as-answered", {"none.nmq", "found no recording", "nearmiss_record.h"});
  expect_refused("replay hit.vt --as-answered", {"hit.vt", "found no recording"});
  expect_refused("replay hit.vt --as-answered --subject wang", {"--as-answered", "--subject"});
  ASSERT_EQ(record("0", "NEARMISS_RECORD=run.nmq"), 0);  // records nothing, so it makes no file
  EXPECT_FALSE(fs::exists(file("run.nmq")));
  ASSERT_EQ(record("1", "NEARMISS_RECORD=/nowhere/run.nmq"), 0);
  EXPECT_THAT(read("recorder.txt"),
              HasSubstr("nearmiss_record: /nowhere/run.nmq: No such file or directory; nothing is recorded"));
}

TEST_F(Recording, WithoutAUsableRecordIsRefused) {
  ASSERT_EQ(record("0 open"), 0);
  expect_refused("replay run.nmq --subject wang", {"run.nmq: found no record, expected some"});
  expect_refused("convert run.nmq -o new", {"run.nmq: found no record, expected some"});
  expect_refused("replay run.nmq --as-answered", {"run.nmq: found no record that can be judged"});
  ASSERT_EQ(record("20 tmax 0"), 0);
  expect_refused("replay run.nmq --subject wang", {"found no record that is complete and has a query"});
  const Output output = expect_code(2, "replay run.nmq --as-answered");
  EXPECT_THAT(output.error,
              HasSubstr("run.nmq: 20 records left out: they have numbers or kinds that no query has"));
}

TEST_F(Recording, MayHaveAnyName) {
  ASSERT_EQ(record("20", "NEARMISS_RECORD=run"), 0);
  EXPECT_THAT(expect_code(0, "replay run --subject wang").out, HasSubstr("no miss in 20 collisions"));
  write("none", "no recording");
  expect_refused("replay none --subject wang", {"none: found an unknown kind of file"});
}

TEST_F(Recording, IsWhereACampaignHunts) {
  ASSERT_EQ(record("100"), 0);
  const auto counts = json_of(1, "fuzz --subject never=" + plugin("never") +
                                     " --near run.nmq --family near --cases 400")["subjects"]["never"];
  EXPECT_EQ(counts.size(), 1);  // only vertices and triangles were recorded
  EXPECT_EQ(counts["vt"]["families"]["near"]["queries"], 400);
  EXPECT_GT(counts["vt"]["families"]["near"]["false_negatives"], 100);
  write("w.ve", "0 0 0  0 0 1  0 0 2   0 0 1  0 0 1  0 0 2   0.5\n");
  const std::string both = "fuzz --subject wang --near run.nmq --near w.ve --family near,v-near-within";
  EXPECT_EQ(
      json_of(0, both + " --cases 400")["subjects"]["wang"]["ve"]["families"]["v-near-within"]["queries"],
      200);
}

}  // namespace
}  // namespace nearmiss
