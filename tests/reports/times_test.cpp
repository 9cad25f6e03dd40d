// Run times of subjects.
#include "reports/statistics/times.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "reports/sections/counts_json.hpp"
#include "reports/text/json.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

TEST(Times, AreMediansOverTheBatchesOfAFamily) {
  SubjectTimes times;
  EXPECT_EQ(times.queries(), 0);
  EXPECT_EQ(times.ns_per_query(), std::nullopt);
  for (const std::uint64_t ns : {500U, 520U, 90'000U}) times.add(Kind::edge_edge, "f", {10, ns});
  EXPECT_EQ(times.ns_per_query(), 52);
  EXPECT_EQ(times.mean(), 91020 / 30.0);
  times.add(Kind::edge_edge, "f", {31, 31 * 40});  // this batch has more queries than all others
  EXPECT_EQ(times.ns_per_query(), 40);
  SubjectTimes others;
  others.add(Kind::edge_edge, "g", {10, 10 * 1000});
  others.add(Kind::vertex_triangle, "f", {10, 0});
  times.merge(others);
  EXPECT_EQ(times.queries(), 81);
  EXPECT_EQ(times.ns_per_query(), (61 * 40 + 10 * 1000 + 10 * 1) / 81.0);
}

TEST(Times, OfBatchesAreRightToThreeDigits) {
  for (const std::uint64_t ns : {1U, 999U, 1000U, 1004U, 1005U, 1234567U}) {
    BatchTimes times;
    times.add({1, ns});
    EXPECT_NEAR(times.median(), static_cast<double>(ns), 5e-3 * static_cast<double>(ns));
  }
  BatchTimes fraction;
  fraction.add({2048, 100'000});
  EXPECT_EQ(fraction.median(), 48.8);
  BatchTimes nothing;
  nothing.add({2048, 3});
  EXPECT_EQ(nothing.median(), 1);
  fraction.add({0, 7});
  EXPECT_EQ(fraction.queries(), 2048);
}

TEST(Times, QuantilesAreRightToAQuarterOfAnOctave) {
  TimeHistogram times;
  EXPECT_EQ(times.quantile(0.5), std::nullopt);
  for (std::uint64_t i = 1; i <= 1000; ++i) times.add(i);
  for (const double part : {0.1, 0.5, 0.99, 1.0}) {
    EXPECT_GE(times.quantile(part), 1000 * part);
    EXPECT_LE(times.quantile(part), 1000 * part * std::exp2(0.25) + 1);
  }
  times.add(0);
  times.add(std::uint64_t{1} << 63);
  EXPECT_EQ(times.total(), 1002);
}

TEST(Times, TheSlowestAreKept) {
  SubjectTimes a;
  SubjectTimes b;
  for (std::uint64_t i = 0; i < 20; ++i)
    (i % 2 == 0 ? a : b).add(i, Query{}, [&] { return std::to_string(i); });
  a.merge(b);
  ASSERT_EQ(a.slowest.size(), SubjectTimes::slow_cases);
  for (std::size_t i = 0; i < SubjectTimes::slow_cases; ++i) EXPECT_EQ(a.slowest[i].nanoseconds, 19 - i);
}

TEST(Times, StandInTheReport) {
  Counts counts;
  for (int i = 0; i < 100; ++i) counts.times.add(50, testing::falling_edge(1, -1), [] { return "f:1:0"; });
  const auto json = counts_json({counts})["times"];
  EXPECT_EQ(json["sampled"], 100);
  for (const char* name : {"median_ns", "q99_ns", "q99.9_ns"}) EXPECT_NEAR(json[name], 50, 10) << name;
}

// Six cases are equally slow. The five whose provenances come first are kept, in whatever order the cases
// come.
TEST(Times, TiesOfTheSlowestAreInTheOrderOfTheirProvenance) {
  const auto kept = [](const std::string& order) {
    SubjectTimes times;
    for (const char name : order) times.add(100, Query{}, [&] { return std::string(1, name); });
    return times;
  };
  const auto names = [](const SubjectTimes& times) {
    std::string all;
    for (const SlowCase& slow : times.slowest) all += slow.provenance;
    return all;
  };
  EXPECT_EQ(names(kept("abcdef")), "abcde");
  EXPECT_EQ(names(kept("fedcba")), "abcde");
  SubjectTimes merged = kept("fdb");
  merged.merge(kept("eca"));
  EXPECT_EQ(names(merged), "abcde");
}

}  // namespace
}  // namespace nearmiss
