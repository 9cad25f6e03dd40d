// Counting and merging.
#include "reports/statistics/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

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
  for (int i = 0; i < 484; ++i) {
    const double ratio = 1e-18 * std::pow(1.1, i);
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
  EXPECT_EQ(counts.ratio_quantile(0.99), (Bin{10, 1000}));  // the last bin has no upper border
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
    const CountsKey key{random() % 2 ? "a" : "b", kinds[random() % 2], random() % 2 ? "f" : "g"};
    Outcome outcome = false_positive(static_cast<double>(random() % 1000) / 500);
    outcome.collision = random() % 2 == 0;
    outcome.verdict.hit = random() % 3 != 0;
    Query own = query;
    own.x[0] = static_cast<double>(random() % 7);
    statistics.counts[key].add(outcome, own, [&] { return std::to_string(random() % 5); });
    statistics.counts[key].times.add(key.kind, key.family, {1 + random() % 3, random() % 100});
  }
  for (const Kind kind : kinds_of_meshes) {
    OracleCounts& oracle = statistics.oracle[{kind, random() % 2 ? "f" : "g"}];
    oracle.queries = random() % 100;
    oracle.by_stage[random() % filter_stage_count] = random() % 100;
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
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Statistics a = random_statistics(3 * seed);
    const Statistics b = random_statistics(3 * seed + 1);
    const Statistics c = random_statistics(3 * seed + 2);
    const Statistics expected = merged({a, b, c});
    EXPECT_EQ(merged({c, a, b}), expected) << "seed " << seed;
    EXPECT_EQ(merged({a, merged({c, b})}), expected) << "seed " << seed;
    EXPECT_EQ(merged({merged({b, a}), c}), expected) << "seed " << seed;
  }
}

Extreme extreme(Extreme::Of of, double value, const std::string& provenance) {
  return {of, "mu", value, testing::falling_edge(0.1, value), provenance, 10};
}

/// Merges two extremes in both orders, expects equal results, and returns their value.
double merged_value(const Extreme& a, const Extreme& b) {
  Extreme ab = a;
  ab.merge(b);
  Extreme ba = b;
  ba.merge(a);
  EXPECT_EQ(ab, ba);
  EXPECT_EQ(ab.queries, a.queries + b.queries);
  return ab.value;
}

TEST(Extreme, KeepsTheLargestFactorOfAnAcceptingTolerance) {
  const auto of = Extreme::Of::accepting_tolerance;
  EXPECT_EQ(merged_value(extreme(of, 0.25, "a"), extreme(of, 0.5, "b")), 0.5);
  EXPECT_EQ(merged_value(extreme(of, 0.25, "a"), nothing_found(of, "mu")), 0.25);
}

TEST(Extreme, KeepsTheSmallestFactorOfOneThatKeepsPrimitivesOut) {
  const auto of = Extreme::Of::keeping_tolerance;
  EXPECT_EQ(merged_value(extreme(of, 20, "a"), extreme(of, 50, "b")), 20);
  EXPECT_EQ(merged_value(extreme(of, 20, "a"), nothing_found(of, "mu")), 20);
}

TEST(Extreme, KeepsOneOfEqualsWhateverTheOrder) {
  const auto of = Extreme::Of::distance;
  EXPECT_EQ(merged_value(extreme(of, 0.5, "a"), extreme(of, 0.5, "b")), 0.5);
  EXPECT_FALSE(nothing_found(of, "mu").found());
}

TEST(Faults, AreNeitherMissesNorAnswers) {
  Counts counts;
  counts.add({.verdict = {.hit = true, .stage = Stage::vv, .fault = Fault::crash}, .collision = true},
             Query{}, [] { return ""; });
  counts.add({.verdict = {.fault = Fault::time}}, Query{}, [] { return ""; });
  Counts expected;
  expected.queries = 2;
  expected.faults_by_class[static_cast<std::size_t>(QueryClass::unclassified)] = 1;  // the crash
  expected.faults[static_cast<std::size_t>(Fault::crash)] = 1;
  expected.faults[static_cast<std::size_t>(Fault::time)] = 1;
  EXPECT_EQ(counts, expected);  // nothing else is counted
  EXPECT_EQ(counts.faults_total(), 2);
  EXPECT_EQ(counts.others(), 0);
}

}  // namespace
}  // namespace nearmiss
