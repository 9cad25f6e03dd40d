// Counting and merging.
#include "reports/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reports/confidence.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

const Query query = testing::falling_vertex(0.25, 0.25, 1, -1);

Outcome false_positive(double ratio, bool refuted = false) {
  return {.verdict = {true, Stage::vv, 0.5}, .collision = false, .ratio = ratio, .bound_refuted = refuted};
}

std::string here() { return "here"; }

TEST(Histogram, ARatioOfOneIsNotCountedBelowTheBound) {
  Histogram histogram;
  histogram.add(std::nextafter(1.0, 0.0));
  histogram.add(1.0);
  std::size_t at_one = 0;
  while (Histogram::border(at_one) < 1) ++at_one;
  EXPECT_EQ(Histogram::border(at_one), 1);
  EXPECT_EQ(histogram.bins[at_one - 1], 1);
  EXPECT_EQ(histogram.bins[at_one], 1);
}

TEST(Histogram, WhatIsBelowOrAboveItsBordersStandsInABinOfItsOwn) {
  Histogram histogram;
  histogram.add(0);
  histogram.add(std::nextafter(1e-16, 0));
  histogram.add(1e-16);
  histogram.add(std::nextafter(10.0, 0));
  histogram.add(10);
  histogram.add(1e300);
  EXPECT_EQ(histogram.bins.front(), 2);
  EXPECT_EQ(histogram.bins[1], 1);
  EXPECT_EQ(histogram.bins[Histogram::bin_count - 2], 1);
  EXPECT_EQ(histogram.bins.back(), 2);
}

TEST(Histogram, ARatioIsInItsBin) {
  for (double ratio = 1e-18; ratio < 100; ratio *= 1.1) {
    Histogram histogram;
    histogram.add(ratio);
    const Bin bin = histogram.quantile(0.5);
    EXPECT_LE(bin.from, ratio);
    EXPECT_LT(ratio, bin.to);
    EXPECT_EQ(bin.from, Histogram::lower_border(ratio));
    EXPECT_EQ(bin.from, Histogram::lower_border(bin.from));
  }
}

TEST(Histogram, AQuantileIsABin) {
  Histogram histogram;
  EXPECT_EQ(histogram.quantile(0.5), Bin{});
  for (int i = 0; i < 99; ++i) histogram.add(0.012);
  histogram.add(1000);
  for (const double part : {0.5, 0.99}) {
    EXPECT_DOUBLE_EQ(histogram.quantile(part).from, 0.01);
    EXPECT_DOUBLE_EQ(histogram.quantile(part).to, std::pow(10, -1.75));
  }
  EXPECT_EQ(histogram.quantile(1), (Bin{10, std::numeric_limits<double>::infinity()}));
}

TEST(Counts, AQuantileOfDistancesIsNeverBeyondTheFarthest) {
  Counts counts;
  counts.add(false_positive(0.5), query, here);
  EXPECT_EQ(counts.ratio_quantile(0.5).to, 0.5);
  counts.add(false_positive(1000), query, here);
  EXPECT_EQ(counts.ratio_quantile(0.99), (Bin{10, 1000}));  // the last bin has no border above
}

TEST(Counts, EachOutcomeIsCountedOnce) {
  Counts counts;
  counts.add({.verdict = {true, Stage::proximity, 0.5}, .collision = true}, query, here);
  counts.add({.verdict = {false, Stage::none, 0}, .collision = true}, query, here);
  counts.add({.verdict = Verdict::rejected(Rejection::planes), .collision = false}, query, here);
  counts.add(false_positive(0.5), query, here);
  counts.add(false_positive(2, true), query, here);
  EXPECT_EQ(counts.queries, 5);
  EXPECT_EQ(counts.collisions, 2);
  EXPECT_EQ(counts.positives, 3);
  EXPECT_EQ(counts.false_negatives, 1);
  EXPECT_EQ(counts.false_positives, 2);
  EXPECT_EQ(counts.refuted_bounds, 1);
  EXPECT_EQ(counts.true_by_stage[static_cast<std::size_t>(Stage::proximity)], 1);
  EXPECT_EQ(counts.false_by_stage[static_cast<std::size_t>(Stage::vv)], 2);
  EXPECT_EQ(counts.rejected_by[static_cast<std::size_t>(Rejection::planes)], 1);
  EXPECT_EQ(counts.rejected_by[static_cast<std::size_t>(Rejection::untold)], 1);
  EXPECT_EQ(counts.max_ratio(), 2);
}

TEST(Counts, KeepsTheFarthestCases) {
  Counts counts;
  for (int i = 0; i < 100; ++i) counts.add(false_positive((i * 37 % 100) / 100.0), query, here);
  ASSERT_EQ(counts.farthest.size(), Counts::far_cases);
  for (std::size_t i = 0; i < Counts::far_cases; ++i)
    EXPECT_EQ(counts.farthest[i].ratio, (99 - static_cast<double>(i)) / 100.0);
}

Statistics random_statistics(unsigned seed) {
  std::mt19937_64 random(seed);
  Statistics statistics;
  for (int i = 0; i < 200; ++i) {
    const Key key{random() % 2 ? "a" : "b", kinds[random() % 2], random() % 2 ? "f" : "g"};
    Outcome outcome = false_positive(static_cast<double>(random() % 1000) / 500);
    outcome.collision = random() % 2 == 0;
    outcome.verdict.hit = random() % 3 != 0;
    Query own = query;
    own.x[0] = static_cast<double>(random() % 7);
    statistics.counts[key].add(outcome, own, [&] { return std::to_string(random() % 5); });
    statistics.counts[key].times.add(key.kind, key.family, {1 + random() % 3, random() % 100});
  }
  for (const Kind kind : kinds) {
    OracleCounts& oracle = statistics.oracle[{kind, random() % 2 ? "f" : "g"}];
    oracle.queries = random() % 100;
    oracle.by_stage[random() % filter_stage_count] = random() % 100;
    oracle.missed_by_parity = random() % 100;
  }
  statistics.oracle_disagreements = random() % 10;
  statistics.mismatches_with_recorded_truth = random() % 10;
  return statistics;
}

Statistics merged(std::initializer_list<Statistics> all) {
  Statistics sum;
  for (const Statistics& each : all) sum.merge(each);
  return sum;
}

TEST(Statistics, MergingInAnyOrderGivesTheSame) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Statistics a = random_statistics(3 * seed);
    const Statistics b = random_statistics(3 * seed + 1);
    const Statistics c = random_statistics(3 * seed + 2);
    const Statistics expected = merged({a, b, c});
    EXPECT_EQ(merged({c, a, b}), expected) << "seed " << seed;
    EXPECT_EQ(merged({a, merged({c, b})}), expected) << "seed " << seed;
    EXPECT_EQ(merged({merged({b, a}), c}), expected) << "seed " << seed;
  }
}

TEST(Statistics, SumsOverFamilies) {
  const Statistics statistics = random_statistics(1);
  std::uint64_t queries = 0;
  for (const auto& [key, counts] : statistics.by_subject_and_kind()) {
    EXPECT_EQ(key.family, "");
    queries += counts.queries;
  }
  EXPECT_EQ(queries, 200);
}

// Clopper and Pearson's bound solves P(X <= count) = 5 % for the binomial X; for 0 in n that is 1 -
// 0.05^(1/n).
TEST(Confidence, NoneSeenInMany) {
  for (const std::uint64_t n : {1U, 10U, 1000U, 1000000U})
    EXPECT_NEAR(clopper_pearson_upper(0, n) / (1 - std::pow(0.05, 1.0 / static_cast<double>(n))), 1, 1e-6);
}

TEST(Confidence, TheTailHasFivePercent) {
  const double p = clopper_pearson_upper(2, 20);
  const double q = 1 - p;
  const double tail = std::pow(q, 20) + 20 * p * std::pow(q, 19) + 190 * p * p * std::pow(q, 18);
  EXPECT_NEAR(tail, 0.05, 1e-9);
}

// P(X <= count) at the upper end and P(X >= count) at the lower one are half of the risk.
TEST(Confidence, EachTailOfTheIntervalHasHalfOfTheRisk) {
  const auto at_most_one = [](double p) { return std::pow(1 - p, 8) * (1 + 8 * p); };  // of 9
  const Interval interval = clopper_pearson(1, 9, 0.01);
  EXPECT_NEAR(at_most_one(interval.hi), 0.005, 1e-9);
  EXPECT_NEAR(1 - std::pow(1 - interval.lo, 9), 0.005, 1e-9);
  EXPECT_EQ(clopper_pearson(0, 9, 0.01).lo, 0);
  EXPECT_EQ(clopper_pearson(9, 9, 0.01).hi, 1);
  EXPECT_EQ(clopper_pearson(0, 0), (Interval{0, 1}));
}

TEST(Confidence, OneWhereNothingIsKnown) {
  EXPECT_EQ(clopper_pearson_upper(0, 0), 1);
  EXPECT_EQ(clopper_pearson_upper(5, 5), 1);
}

TEST(Times, AreMediansOverTheBatchesOfAFamily) {
  Times times;
  EXPECT_EQ(times.queries(), 0);
  EXPECT_TRUE(std::isnan(times.ns_per_query()));
  for (const std::uint64_t ns : {500U, 520U, 90'000U}) times.add(Kind::edge_edge, "f", {10, ns});
  EXPECT_EQ(times.ns_per_query(), 52);
  EXPECT_EQ(times.mean(), 91020 / 30.0);
  times.add(Kind::edge_edge, "f", {31, 31 * 40});  // more queries than all others
  EXPECT_EQ(times.ns_per_query(), 40);
  Times others;
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
  EXPECT_TRUE(std::isnan(times.quantile(0.5)));
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
  Times a;
  Times b;
  for (std::uint64_t i = 0; i < 20; ++i)
    (i % 2 == 0 ? a : b).add(i, Query{}, [&] { return std::to_string(i); });
  a.merge(b);
  ASSERT_EQ(a.slowest.size(), Times::slow_cases);
  for (std::size_t i = 0; i < Times::slow_cases; ++i) EXPECT_EQ(a.slowest[i].nanoseconds, 19 - i);
}

TEST(Faults, AreNeitherMissesNorAnswers) {
  Counts counts;
  counts.add({.verdict = {.fault = Fault::crash}, .collision = true}, Query{}, [] { return ""; });
  EXPECT_EQ(counts.faults_total(), 1);
  EXPECT_EQ(counts.queries, 1);
  EXPECT_EQ(counts.collisions, 0);  // so that it is in no denominator
  EXPECT_EQ(counts.others(), 0);
  EXPECT_EQ(counts.false_negatives, 0);
  EXPECT_EQ(clopper_pearson_upper(counts.false_negatives, counts.collisions), 1);
}

}  // namespace
}  // namespace nearmiss
