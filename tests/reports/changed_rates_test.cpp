// Rates that have changed since a baseline.
#include "reports/sections/baseline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "reports/sections/headline.hpp"
#include "reports/text/json.hpp"
#include "tests/reports/campaigns.hpp"

namespace nearmiss {
namespace {

using ::nearmiss::testing::campaign;
using ::nearmiss::testing::counts;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const CountsKey key{"wang", Kind::edge_edge, "uniform"};

TEST(Changes, ARateThatDiffersAsChanceExplainsHasNotChanged) {
  const Campaign before = campaign("1", {{key, counts(200000, 100000, 0, 1000)}});
  const Campaign now = campaign("2", {{key, counts(200000, 100000, 0, 1100)}});
  const Changes found = changes(now, before);
  EXPECT_THAT(found.rates, IsEmpty());
  EXPECT_EQ(found.compared_rates, 4);
  EXPECT_THAT(lines_for_the_worse(found), IsEmpty());
  ASSERT_THAT(found.facts, SizeIs(1));
  EXPECT_EQ(found.facts[0].name + found.facts[0].before + found.facts[0].now, "seed12");
}

TEST(Changes, ARateThatDiffersByMoreIsBetterOrWorse) {
  const Campaign few = campaign("1", {{key, counts(200000, 100000, 0, 1000)}});
  const Campaign many = campaign("1", {{key, counts(200000, 100000, 0, 1400)}});
  const Changes worse = changes(many, few);
  ASSERT_THAT(worse.rates, SizeIs(1));
  EXPECT_EQ(worse.rates[0].what, "false positives");
  EXPECT_THAT(lines_for_the_worse(worse), SizeIs(1));
  EXPECT_EQ(describe(worse),
            "worse: false positives of wang ee in uniform, 1,000 of 100,000 before, 1,400 of 100,000 now\n");
  const Changes better = changes(few, many);
  ASSERT_THAT(better.rates, SizeIs(1));
  EXPECT_THAT(lines_for_the_worse(better), IsEmpty());
  EXPECT_THAT(describe(better), HasSubstr("better: "));
  const auto since = scorecard_json(few.statistics, {}, better)[0]["since"];
  EXPECT_EQ(since["worse"], 0);
  EXPECT_EQ(since["better"], 1);
}

TEST(Changes, TheMoreRatesAreComparedTheMoreItTakes) {
  const auto with_others = [](std::uint64_t false_positives) {
    std::map<CountsKey, Counts> all{{key, counts(200000, 100000, 0, false_positives)}};
    for (int i = 0; i < 10000; ++i)
      all[{"wang", Kind::edge_edge, "family " + std::to_string(i)}] = counts(200000, 100000, 0, 0);
    return campaign("1", std::move(all));
  };
  const auto alone = [](std::uint64_t false_positives) {
    return campaign("1", {{key, counts(200000, 100000, 0, false_positives)}});
  };
  EXPECT_THAT(changes(alone(1200), alone(1000)).rates, SizeIs(1));
  EXPECT_THAT(changes(with_others(1200), with_others(1000)).rates, IsEmpty());
}

// If there was no failure before, 11 failures in 10,000 queries are significant in a single test. With 4
// tests that share the risk 0.001, it takes 13 failures.
TEST(Changes, AFewAfterNoneAreEnough) {
  const auto with = [](std::uint64_t missed) {
    return campaign("1", {{key, counts(20000, 10000, missed, 0)}});
  };
  EXPECT_THAT(changes(with(12), with(0)).rates, IsEmpty());
  const Changes found = changes(with(13), with(0));
  ASSERT_THAT(found.rates, SizeIs(1));
  EXPECT_LT(found.rates[0].p, false_alarm_risk / 4);
}

// No single family has enough failures to be noticed, but all families together have.
TEST(Changes, AFewInEachOfManyFamiliesAreNoticed) {
  const auto with = [](std::uint64_t missed, std::uint64_t in_the_last) {
    std::map<CountsKey, Counts> all;
    for (int i = 0; i < 30; ++i)
      all[{"basic", kinds[static_cast<std::size_t>(i % 3)], "family " + std::to_string(i)}] =
          counts(20000, 10000, missed, 0);
    all[{"basic", Kind::edge_edge, "last"}] = counts(20000, 10000, in_the_last, 0);
    return campaign("1", std::move(all));
  };
  const Changes found = changes(with(1, 500), with(0, 500));
  ASSERT_THAT(found.rates, SizeIs(1));
  EXPECT_THAT(lines_for_the_worse(found), SizeIs(1));
  // Families with few failures are added up three times, with three limits for "few"; so p is multiplied by
  // 3.
  EXPECT_NEAR(found.rates[0].p, 3 * 2 * std::pow(0.5, 30), 1e-15);
  EXPECT_EQ(
      describe(found),
      "worse: false negatives of basic vt, ee, vv in families with at most 5, 0 of 300,000 before, 30 of "
      "300,000 now\n");
  EXPECT_THAT(describe(changes(with(12, 500), with(6, 500))),
              HasSubstr("in families with at most 20, 180 of"));
  EXPECT_THAT(changes(with(1, 500), with(1, 500)).rates, IsEmpty());
  EXPECT_THAT(changes(with(0, 510), with(0, 500)).rates, IsEmpty());
}

// The number of false positives is the same, but now a few of them are far from contact.
TEST(Changes, AFewFarFalsePositivesAreNoticed) {
  const auto with = [](std::uint64_t far, std::uint64_t measured_by_wang = 0) {
    std::map<CountsKey, Counts> all;
    for (int i = 0; i < 10; ++i) {
      Counts c = counts(20000, 10000, 0, 1000);
      for (std::uint64_t k = 0; k < 1000; ++k) c.distances.add(k < far ? 1 : 1e-3);
      c.measured_by_wang = measured_by_wang;
      all[{"basic", Kind::edge_edge, "family " + std::to_string(i)}] = c;
    }
    return campaign("1", std::move(all));
  };
  const Changes found = changes(with(2), with(0));
  ASSERT_THAT(found.rates, SizeIs(1));
  EXPECT_EQ(found.rates[0].what, "false positives beyond the bound");
  EXPECT_THAT(found.rates[0].now.count, 20);
  EXPECT_THAT(changes(with(1), with(0)).rates, IsEmpty());
  const Changes unclaimed = changes(with(2, 1000), with(0, 1000));
  ASSERT_THAT(unclaimed.rates, SizeIs(1));
  EXPECT_EQ(unclaimed.rates[0].what, "false positives beyond wang's bound (no claim)");
}

// For family a, p is 2 / 2^13, between 1/5 and 1/4 of the risk. It is no longer significant if the sum over
// families is a fifth comparison.
TEST(Changes, ASumOverFamiliesIsAComparisonToo) {
  const auto with = [](std::uint64_t in_a, std::uint64_t in_b) {
    return campaign("1", {{{"basic", Kind::edge_edge, "a"}, counts(10000, 10000, in_a, 0)},
                          {{"basic", Kind::edge_edge, "b"}, counts(10000, 10000, in_b, 0)}});
  };
  const Changes alone = changes(with(13, 0), with(0, 0));
  EXPECT_EQ(alone.compared_rates, 4);
  EXPECT_THAT(alone.rates, SizeIs(1));
  const Changes with_sum = changes(with(13, 1), with(0, 0));
  EXPECT_EQ(with_sum.compared_rates, 5);
  EXPECT_THAT(with_sum.rates, IsEmpty());
}

TEST(Changes, CasesAndMeshesAreNoSamples) {
  const CountsKey cases{"wang", Kind::edge_edge, "planar/"};
  const CountsKey mesh{"wang", Kind::edge_edge, "scene:cloth"};
  const Campaign before = campaign("1", {{cases, counts(1000, 0, 0, 0)}, {mesh, counts(1000, 0, 0, 0)}});
  const Campaign now = campaign("1", {{cases, counts(1000, 0, 0, 1000)}, {mesh, counts(1000, 0, 0, 1000)}});
  EXPECT_EQ(changes(now, before).compared_rates, 0);
}

}  // namespace
}  // namespace nearmiss
