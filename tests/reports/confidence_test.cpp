// Confidence bounds and exact tests of rates.
#include "reports/statistics/confidence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace nearmiss {
namespace {

// The bound of Clopper and Pearson is the rate at which P(X <= count) = 5 % for a binomial X. For 0 events
// in n trials, the bound is 1 - 0.05^(1/n).
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

// At the upper end of the interval, P(X <= count) is half of the risk; at the lower end, P(X >= count) is.
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
  // Both campaigns ask the same number of queries. With probability 11 / 1024, 9 or more of 10 failures are
  // in the campaign called `now`.
  const ExactTest nine_of_ten = pooled_test({{{4, 100}, {1, 100}}, {{5, 700}, {0, 700}}});
  EXPECT_NEAR(nine_of_ten.more, 11.0 / 1024, 1e-12);
  EXPECT_NEAR(nine_of_ten.less, 1023.0 / 1024, 1e-12);
  // One family has three times as many queries now as before, the other has as many now as before. On
  // average, two thirds of the 6 failures are expected to be seen now.
  EXPECT_NEAR(pooled_test({{{4, 300}, {0, 100}}, {{2, 100}, {0, 100}}}).more,
              std::pow((4 * 0.75 + 2 * 0.5) / 6, 6), 1e-12);
  EXPECT_EQ(pooled_test({{{3, 100}, {3, 100}}}).either(), 1);
  EXPECT_EQ(pooled_test({}).either(), 1);
}

// For large numbers, the test uses the binomial distribution, whose p-value is larger than the exact one.
// For small shares, it is only slightly larger.
TEST(FisherTest, OfLargeNumbersIsNearTheBinomial) {
  const double small = fisher_test({60, 1ULL << 30}, {30, (1ULL << 30) - 1}).more;
  const double large = fisher_test({60, 1ULL << 31}, {30, 1ULL << 31}).more;
  EXPECT_GE(large, small);
  EXPECT_NEAR(large / small, 1, 1e-3);
  EXPECT_LT(fisher_test({600000, 1200000}, {590000, 1200000}).more, 1e-9);
}

}  // namespace
}  // namespace nearmiss
