// Tests how statistics are counted and merged, the order of classes, and the confidence bounds of rates.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "reports/statistics/confidence.hpp"
#include "reports/statistics/query_class.hpp"
#include "reports/statistics/statistics.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using testing::falling_vertex;

const Query falling_query = testing::falling_vertex(0.25, 0.25, 1, -1);

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
  counts.add(false_positive(0.5), falling_query, here);
  EXPECT_EQ(counts.ratio_quantile(0.5).to, 0.5);
  counts.add(false_positive(1000), falling_query, here);
  EXPECT_EQ(counts.ratio_quantile(0.99), (Bin{10, 1000}));  // the last bin has no upper border
}

TEST(Counts, EachOutcomeIsCountedOnce) {
  Counts counts;
  counts.add({.verdict = {true, Stage::proximity, 0.5}, .collision = true}, falling_query, here);
  counts.add({.verdict = {false, Stage::none, 0}, .collision = true}, falling_query, here);
  counts.add({.verdict = Verdict::rejected(Rejection::planes), .collision = false}, falling_query, here);
  counts.add(false_positive(0.5), falling_query, here);
  counts.add(false_positive(2, true), falling_query, here);
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
  for (int i = 0; i < 100; ++i) counts.add(false_positive((i * 37 % 100) / 100.0), falling_query, here);
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
    Query own = falling_query;
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

TEST(Exoticness, OrdersClassesAndDegenerateQueriesWithinTheirs) {
  Query zeros;
  zeros.x[5] = -0.0;
  EXPECT_EQ(exoticness(falling_query, QueryClass::ordinary), 0);
  EXPECT_EQ(exoticness(falling_query, QueryClass::degenerate), 1);
  EXPECT_EQ(exoticness(falling_vertex(0, 0, 1, 0), QueryClass::degenerate), 2);
  EXPECT_EQ(exoticness(zeros, QueryClass::degenerate), 3);
  EXPECT_EQ(exoticness(testing::moved(zeros, 1), QueryClass::degenerate), 3);
  EXPECT_EQ(exoticness(falling_query, QueryClass::extreme), 4);
  EXPECT_EQ(exoticness(zeros, QueryClass::extreme), 5);
  EXPECT_EQ(exoticness(falling_query, QueryClass::unclassified), 6);
  for (const Kind kind : kinds_of_vertices) {  // the queries of these kinds repeat a vertex
    const std::array<double, 18> different{0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 1, 2, 1, 3, 4, 5, 9};
    EXPECT_EQ(exoticness(query_of(kind, different.data()), QueryClass::degenerate), 1);
  }
}

TEST(Exoticness, PointsCoincideIfTwoVerticesDoAtOneEndOfTheStep) {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      Query moving = falling_query;
      // Vertex i ends where vertex j starts, so both vertices coincide at the end of the step only if j
      // rests.
      moving.set_end(i, moving.start(j));
      const int expected = i != j && j > 0 ? 2 : 1;
      EXPECT_EQ(exoticness(moving, QueryClass::degenerate), expected) << i << ' ' << j;
      moving.set_end(i, moving.end(j));
      EXPECT_EQ(exoticness(moving, QueryClass::degenerate), i == j ? 1 : 2) << i << ' ' << j;
    }
}

// The upper bound of Clopper and Pearson is the rate at which P(X <= count) = 5 % for a binomial X. For 0
// events in n trials, this bound is 1 - 0.05^(1/n).
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

// At the upper end of the interval, P(X <= count) is half of the risk; at the lower end, P(X >= count) is
// half of the risk.
TEST(Confidence, EachTailOfTheIntervalHasHalfOfTheRisk) {
  const auto at_most_one = [](double p) { return std::pow(1 - p, 8) * (1 + 8 * p); };  // of 9 trials
  const ConfidenceInterval interval = clopper_pearson(1, 9, 0.01);
  EXPECT_NEAR(at_most_one(interval.hi), 0.005, 1e-9);
  EXPECT_NEAR(1 - std::pow(1 - interval.lo, 9), 0.005, 1e-9);
  EXPECT_EQ(clopper_pearson(0, 9, 0.01).lo, 0);
  EXPECT_EQ(clopper_pearson(9, 9, 0.01).hi, 1);
  EXPECT_EQ(clopper_pearson(0, 0), (ConfidenceInterval{0, 1}));
  EXPECT_EQ(clopper_pearson_upper(0, 0), 1);
  EXPECT_EQ(clopper_pearson_upper(5, 5), 1);
}

TEST(FisherTest, IsTheOneOfTheLadyTastingTea) {
  const ExactTest three_of_four = fisher_test({3, 4}, {1, 4});  // Fisher 1935: 17 / 70
  EXPECT_NEAR(three_of_four.more, 17.0 / 70, 1e-12);
  EXPECT_NEAR(three_of_four.less, 69.0 / 70, 1e-12);
  EXPECT_NEAR(fisher_test({4, 4}, {0, 4}).more, 1.0 / 70, 1e-12);
  EXPECT_EQ(fisher_test({0, 4}, {0, 4}).either(), 1);
  EXPECT_EQ(fisher_test({4, 4}, {4, 4}).either(), 1);
  EXPECT_EQ(fisher_test({0, 0}, {3, 4}).either(), 1);
}

TEST(PooledTest, IsABinomialOne) {
  // Both campaigns ask the same number of queries. If nothing has changed, 9 or 10 of the 10 failures are in
  // the later campaign with probability 11 / 1024.
  const ExactTest nine_of_ten = pooled_test({{{4, 100}, {1, 100}}, {{5, 700}, {0, 700}}});
  EXPECT_NEAR(nine_of_ten.more, 11.0 / 1024, 1e-12);
  EXPECT_NEAR(nine_of_ten.less, 1023.0 / 1024, 1e-12);
  // If nothing has changed, the later campaign is expected to have 3/4 of the 4 failures in one family, and
  // 1/2 of the 2 failures in the other.
  EXPECT_NEAR(pooled_test({{{4, 300}, {0, 100}}, {{2, 100}, {0, 100}}}).more,
              std::pow((4 * 0.75 + 2 * 0.5) / 6, 6), 1e-12);
  EXPECT_EQ(pooled_test({{{3, 100}, {3, 100}}}).either(), 1);
  EXPECT_EQ(pooled_test({}).either(), 1);
}

// For large numbers, fisher_test() uses the binomial distribution. The resulting p-value is larger than the
// exact one. If few of the queries fail, it is only slightly larger.
TEST(FisherTest, OfLargeNumbersIsNearTheBinomial) {
  const double small = fisher_test({60, 1ULL << 30}, {30, (1ULL << 30) - 1}).more;
  const double large = fisher_test({60, 1ULL << 31}, {30, 1ULL << 31}).more;
  EXPECT_GE(large, small);
  EXPECT_NEAR(large / small, 1, 1e-3);
  EXPECT_LT(fisher_test({600000, 1200000}, {590000, 1200000}).more, 1e-9);
}

}  // namespace
}  // namespace nearmiss
