// nearmiss bench: stored runs and their comparison.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "reports/text/json.hpp"
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using testing::CommandLine;
using ::testing::HasSubstr;

/// A stored run with one row, "own.vt", which has these times, one for each pass.
std::string stored(const std::vector<std::string>& times, const std::string& cpu = "cpu",
                   const std::string& subject = "wang") {
  return fmt::format(
      R"({{"about":{{"cpu":"{}"}},"rows":[{{"input":"own.vt","kind":"vt","queries":7,"subject":"{}","ns":[{}]}}]}})"
      "\n",
      cpu, subject, fmt::join(times, ","));
}

/// A history of runs, each with one pass.
std::string history(const std::vector<std::string>& times) {
  std::string lines;
  for (const std::string& time : times) lines += stored({time});
  return lines;
}

class Bench : public CommandLine {
 protected:
  [[nodiscard]] Output compare(int code, const std::string& before, const std::string& after) const {
    write("before", before);
    write("after", after);
    return expect_code(code, "bench --compare before after");
  }
  void expect_comparison(const std::string& before, const std::string& after, const std::string& row) const {
    EXPECT_THAT(compare(0, before, after).out, HasSubstr(row));
  }
  void expect_incomparable(const std::string& before, const std::string& after,
                           const std::string& line) const {
    const Output output = compare(2, before, after);
    EXPECT_EQ(output.error, "nearmiss: " + line + "\n");
    EXPECT_EQ(output.out, "");
  }
};

TEST_F(Bench, ComparesRunsPairByPair) {
  const std::string before = history({"10", "20", "30", "40", "50", "60"});
  expect_comparison(before, history({"9", "18", "27", "36", "45", "54"}),
                    "own.vt  vt    wang           7    40.0   36.0  0.900    0.900-0.900  faster");
  expect_comparison(before, history({"11", "22", "33", "44", "55", "90"}), "1.100    1.100-1.500  slower");
  expect_comparison(before, history({"9", "22", "33", "44", "55", "66"}),
                    "1.100    0.900-1.100  within noise");
  expect_comparison(before, before, "1.000    1.000-1.000  within noise");
}

TEST_F(Bench, LeavesExtremeRatiosOutOfTheIntervalOfManyPairs) {
  std::vector<std::string> times(11, "10");
  const std::string before = history(times);
  for (std::string& time : times) time = "8";
  times[3] = "90";
  expect_comparison(before, history(times), "0.800    0.800-0.800  faster");
  times[4] = "11";
  expect_comparison(before, history(times), "0.800    0.800-1.100  within noise");
}

TEST_F(Bench, ComparesTheMedianOfThePasses) {
  std::string before;
  std::string after;
  for (int i = 0; i < 6; ++i) {
    before += stored({"10", "1000", "10"});
    after += stored({"null", "20", "20", "1"});
  }
  expect_comparison(before, after, "2.000    2.000-2.000  slower");
}

TEST_F(Bench, SaysWhichRowsAreNotInAllRuns) {
  std::string other;
  for (int i = 0; i < 6; ++i) other += stored({"1"}, "cpu", i < 5 ? "wang" : "exact");
  expect_comparison(history({"1", "1", "1", "1", "1", "1"}), other, "-              -  not in all runs");
  expect_comparison(history({"1", "1", "1", "1", "1", "null"}), other, "-              -  not in all runs");
}

TEST_F(Bench, RefusesRunsThatCannotBeCompared) {
  const std::string six = history({"1", "1", "1", "1", "1", "1"});
  expect_incomparable(six, history({"1"}), "found 6 and 1 runs, expected as many of both, and at least 6");
  expect_incomparable(history({"1"}), history({"1"}),
                      "found 1 and 1 runs, expected as many of both, and at least 6");
  expect_incomparable(six, six.substr(0, six.rfind("{\"about\"")) + stored({"1"}, "another"),
                      "found runs on 'another' and 'cpu', expected those of one processor");
  expect_incomparable(six, six + "{\"rows\":[]}\n",
                      "after:7: found '{\"rows\":[]}', expected a run that nearmiss bench --history stored");
  expect_incomparable("", "1 2 3\n",
                      "after:1: found '1 2 3', expected a run that nearmiss bench --history stored");
}

TEST_F(Bench, AddsARunToAHistory) {
  write("own.vt", hit);
  const std::string earlier = stored({"1.5"});
  write("runs", earlier);
  for (int i = 0; i < 2; ++i) {
    expect_code(0, "bench own.vt --queries 3 --runs 2 --history runs");
  }
  const std::string text = read("runs");
  EXPECT_EQ(text.substr(0, earlier.size()), earlier);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
  EXPECT_THAT(text, HasSubstr(R"("input":"own.vt","kind":"vt","queries":1,"subject":"basic","ns":[)"));
}

TEST_F(Bench, DoesNotTouchAFileThatIsNoHistory) {
  write("notes", "my notes\n");
  const Output output = expect_code(2, "bench --queries 3 --runs 1 --history notes");
  EXPECT_EQ(output.out, "") << "it is noticed before anything is timed";
  EXPECT_EQ(output.error,
            "nearmiss: notes:1: found 'my notes', expected a run that nearmiss bench --history stored\n");
  EXPECT_EQ(read("notes"), "my notes\n");
}

TEST_F(Bench, ShowsTheThroughputOfAPluginAndItsTimeWithoutCopies) {
  const Output output = expect_code(0, "bench --subject basic," + plugin("batches") +
                                           ":rows --family stiff,uniform --kind ee --queries 3000 --runs 3 "
                                           "--query-time 1h --json b.json");
  EXPECT_THAT(output.out, HasSubstr("ns/query     /basic    queries/s   kernels\n"));
  const auto results = nlohmann::json::parse(read("b.json"))["results"];
  ASSERT_EQ(results.size(), 4);
  for (std::size_t i = 0; i < results.size(); ++i) {
    EXPECT_EQ(results[i]["input"], i < 2 ? "stiff" : "uniform");
    EXPECT_EQ(results[i]["kind"], "ee");
    EXPECT_EQ(results[i]["queries"], 3000);
    EXPECT_EQ(results[i].contains("queries_per_second"), i % 2 == 1) << "it is no built-in subject";
    EXPECT_EQ(results[i].contains("ns_per_query_of_kernels"), i % 2 == 1);
  }
  EXPECT_EQ(results[1]["ns_per_query_of_kernels"], results[1]["ns_per_query"])
      << "it says that it takes forever";
}

TEST_F(Bench, RefusesABatchThatDoesNotFitBeforeItIsMade) {
  const std::string large = "bench --kind vt --subject " + plugin("batches") + ":rows ";
  EXPECT_EQ(
      expect_code(2, large + "--queries 100000 --query-memory 8000000").error,
      "nearmiss: rows: a batch of 100000 queries needs 24 MiB of memory, found a limit of 7 MiB, expected a "
      "larger --query-memory or fewer queries\n");
  const Output output = expect_code(2, large + "--queries 4000000000");
  EXPECT_THAT(output.error, HasSubstr("nearmiss: --queries 4000000000 needs "));
  EXPECT_THAT(output.error, HasSubstr(" MiB of memory, found "));
  EXPECT_EQ(output.out, "");
}

TEST_F(Bench, JudgesABatchOnRequest) {
  const std::string bench =
      "bench --family uniform --kind vt --queries 100000 --runs 1 --json - --subject wang," + plugin("never");
  const auto rows = nlohmann::json::parse(expect_code(1, bench + " --judge").out)["results"];
  ASSERT_EQ(rows.size(), 2U);
  for (const auto& row : rows) {
    EXPECT_GT(row["collisions"], 1000);
    EXPECT_EQ(row["collisions"].get<int>() + row["others"].get<int>(), 100'000);
  }
  EXPECT_EQ(rows[0]["false_negatives"], 0);
  EXPECT_GT(rows[0]["false_positives"], 0);
  EXPECT_EQ(rows[1]["false_negatives"], rows[1]["collisions"]);
  EXPECT_EQ(rows[1]["false_positives"], 0);
  EXPECT_FALSE(nlohmann::json::parse(expect_code(0, bench).out)["results"][0].contains("false_negatives"));
}

TEST_F(Bench, RefusesAKindThatAFamilyLacks) {
  expect_refused("bench --family uniform --kind vv --queries 5", {"--kind: found vv"});
  expect_refused("bench --family unifrom --queries 5", {"unifrom"});
}

}  // namespace
}  // namespace nearmiss
