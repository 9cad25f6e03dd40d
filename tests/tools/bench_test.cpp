// Tests nearmiss bench: its results, the runs that it stores, and its comparison of stored runs.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using testing::CommandLine;
using ::testing::HasSubstr;

/// A line of a history, for a run that timed one input, "own.vt". `times` has the ns per query of each pass.
std::string stored(const std::vector<std::string>& times, const std::string& cpu = "cpu",
                   const std::string& subject = "wang") {
  return fmt::format(
      R"({{"about":{{"cpu":"{}"}},"rows":[{{"input":"own.vt","kind":"vt","queries":7,"subject":"{}","ns":[{}]}}]}})"
      "\n",
      cpu, subject, fmt::join(times, ","));
}

/// A history with one run for each of `times`. Each run has one pass.
std::string history(const std::vector<std::string>& times) {
  std::string lines;
  for (const std::string& time : times) lines += stored({time});
  return lines;
}

const std::string ones = history({"1", "1", "1", "1", "1", "1"});

class Bench : public CommandLine {
 protected:
  /// Expects that the table that compares two histories contains `row`.
  void expect_comparison(const std::string& before, const std::string& after, const std::string& row) const {
    write("before", before);
    write("after", after);
    EXPECT_THAT(expect_code(0, "bench --compare before after").out, HasSubstr(row));
  }
};

TEST_F(Bench, ComparesRunsPairByPair) {
  const std::string before = history({"10", "20", "30", "40", "50", "60"});
  expect_comparison(before, history({"9", "18", "27", "36", "45", "54"}),
                    "own.vt  vt    wang           7    40.0   36.0  0.900    0.900-0.900  faster");
  expect_comparison(before, history({"11", "22", "33", "44", "55", "90"}), "1.100    1.100-1.500  slower");
  expect_comparison(before, history({"9", "22", "33", "44", "55", "66"}),
                    "1.100    0.900-1.100  within noise");
  // With many pairs of runs, the confidence interval leaves out extreme ratios of times.
  std::vector<std::string> times(11, "8");
  times[3] = "90";
  const std::string tens = history(std::vector<std::string>(11, "10"));
  expect_comparison(tens, history(times), "0.800    0.800-0.800  faster");
  times[4] = "11";
  expect_comparison(tens, history(times), "0.800    0.800-1.100  within noise");
}

TEST_F(Bench, ComparesTheMedianOfThePasses) {
  std::string before, after, other;
  for (int i = 0; i < 6; ++i) {
    before += stored({"10", "1000", "10"});
    after += stored({"null", "20", "20", "1"});
    other += stored({"1"}, "cpu", i < 5 ? "wang" : "exact");
  }
  expect_comparison(before, after, "2.000    2.000-2.000  slower");
  expect_comparison(ones, other, "-              -  not in all runs");
  expect_comparison(ones, history({"1", "1", "1", "1", "1", "null"}), "-              -  not in all runs");
}

TEST_F(Bench, RefusesRunsThatCannotBeCompared) {
  write("before", ones);
  const std::string few = "runs, expected as many of both, and at least 6";
  const std::string no_run = "expected a run that nearmiss bench --history stored";
  for (const auto& [after, line] : std::vector<std::pair<std::string, std::string>>{
           {history({"1"}), "found 6 and 1 " + few},
           {ones.substr(0, ones.rfind("{\"about\"")) + stored({"1"}, "another"),
            "found runs on 'another' and 'cpu', expected those of one processor"},
           {ones + "{\"rows\":[]}\n", "after:7: found '{\"rows\":[]}', " + no_run},
           {"1 2 3\n", "after:1: found '1 2 3', " + no_run}}) {
    write("after", after);
    expect_refused("bench --compare before after", {line});
    EXPECT_EQ(read("out.txt"), "");
  }
}

TEST_F(Bench, AddsARunToAHistory) {
  const std::string earlier = stored({"1.5"});
  write("runs", earlier);
  expect_code(0, "bench hit.vt --queries 3 --runs 2 --history runs");
  const std::string text = read("runs");
  EXPECT_EQ(text.substr(0, earlier.size()), earlier);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
  EXPECT_THAT(text, HasSubstr(R"("input":"hit.vt","kind":"vt","queries":1,"subject":"basic","ns":[)"));
  write("notes", "my notes\n");
  expect_refused("bench --queries 3 --runs 1 --history notes", {"notes:1: found 'my notes', expected a run"});
  EXPECT_EQ(read("out.txt"), "") << "it is noticed before anything is timed";
  EXPECT_EQ(read("notes"), "my notes\n");
}

TEST_F(Bench, ShowsTheThroughputOfAPluginAndItsTimeWithoutCopies) {
  const auto results = json_of(0, "bench --subject basic," + plugin("batches") +
                                      ":rows --family stiff,uniform --kind ee --queries 3000 --runs 3 "
                                      "--query-time 1h")["results"];
  EXPECT_THAT(read("error.txt"), HasSubstr("ns/query     /basic    queries/s   kernels\n"));
  ASSERT_EQ(results.size(), 4);
  for (std::size_t i = 0; i < results.size(); ++i) {
    EXPECT_EQ(results[i]["input"], i < 2 ? "stiff" : "uniform");
    EXPECT_EQ(results[i]["kind"], "ee");
    EXPECT_EQ(results[i]["queries"], 3000);
    EXPECT_EQ(results[i]["runs"], 3);
    EXPECT_EQ(results[i].contains("queries_per_second"), i % 2 == 1) << "it is no built-in subject";
    EXPECT_EQ(results[i].contains("ns_per_query_of_kernels"), i % 2 == 1);
  }
  EXPECT_EQ(results[1]["ns_per_query_of_kernels"], results[1]["ns_per_query"])
      << "it says that it takes forever";
}

TEST_F(Bench, SaysThatASubjectGivesNoAnswer) {
  const auto results = json_of(1, "bench --queries 1 --runs 1 --subject basic," + plugin("crash"),
                               "NEARMISS_ONE_IN=1")["results"];
  EXPECT_THAT(read("error.txt"), ::testing::MatchesRegex(".*misbehaving +no answer +no answer\n.*"));
  EXPECT_GT(results[0]["ns_per_query"], 0);
  for (const char* none : {"ns_per_query", "ratio"}) EXPECT_EQ(results[1][none], nullptr);
}

TEST_F(Bench, RefusesWhatItCannotAsk) {
  const std::string large = "bench --kind vt --subject " + plugin("batches") + ":rows ";
  expect_refused(large + "--queries 100000 --query-memory 8000000",
                 {"nearmiss: rows: a batch of 100000 queries needs 24 MiB of memory, found a limit of 7 MiB, "
                  "expected a larger --query-memory or fewer queries\n"});
  expect_refused(large + "--queries 4000000000",
                 {"nearmiss: --queries 4000000000 needs ", " MiB of memory, found "});
  expect_refused("bench --family uniform --kind vv --queries 5", {"--kind: found vv"});
  expect_refused("bench --family unifrom --queries 5", {"unifrom"});
}

TEST_F(Bench, JudgesABatchOnRequest) {
  const std::string bench =
      "bench --family uniform --kind vt --queries 100000 --runs 1 --subject wang," + plugin("never");
  const auto rows = json_of(1, bench + " --judge")["results"];
  ASSERT_EQ(rows.size(), 2U);
  for (const auto& row : rows) {
    EXPECT_GT(row["collisions"], 1000);
    EXPECT_EQ(row["collisions"].get<int>() + row["others"].get<int>(), 100'000);
  }
  EXPECT_EQ(rows[0]["false_negatives"], 0);
  EXPECT_GT(rows[0]["false_positives"], 0);
  EXPECT_EQ(rows[1]["false_negatives"], rows[1]["collisions"]);
  EXPECT_EQ(rows[1]["false_positives"], 0);
  EXPECT_FALSE(json_of(0, bench)["results"][0].contains("false_negatives"));
}

}  // namespace
}  // namespace nearmiss
