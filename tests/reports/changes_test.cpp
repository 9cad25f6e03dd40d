// Rates and run times that have changed since a baseline.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "reports/sections/baseline.hpp"
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
using Slowness = std::function<double(const CountsKey&)>;

const CountsKey uniform{"wang", Kind::edge_edge, "uniform"};

TEST(Changes, ARateThatDiffersAsChanceExplainsHasNotChanged) {
  const Campaign before = campaign("1", {{uniform, counts(200000, 100000, 0, 1000)}});
  const Campaign now = campaign("2", {{uniform, counts(200000, 100000, 0, 1100)}});
  const Changes found = changes(now, before);
  EXPECT_THAT(found.rates, IsEmpty());
  EXPECT_EQ(found.compared_rates, 4);
  EXPECT_THAT(lines_for_the_worse(found), IsEmpty());
  ASSERT_THAT(found.facts, SizeIs(1));
  EXPECT_EQ(found.facts[0].name + found.facts[0].before + found.facts[0].now, "seed12");
}

TEST(Changes, ARateThatDiffersByMoreIsBetterOrWorse) {
  const Campaign few = campaign("1", {{uniform, counts(200000, 100000, 0, 1000)}});
  const Campaign many = campaign("1", {{uniform, counts(200000, 100000, 0, 1400)}});
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
    std::map<CountsKey, Counts> all{{uniform, counts(200000, 100000, 0, false_positives)}};
    for (int i = 0; i < 10000; ++i)
      all[{"wang", Kind::edge_edge, "family " + std::to_string(i)}] = counts(200000, 100000, 0, 0);
    return campaign("1", std::move(all));
  };
  const auto alone = [](std::uint64_t false_positives) {
    return campaign("1", {{uniform, counts(200000, 100000, 0, false_positives)}});
  };
  EXPECT_THAT(changes(alone(1200), alone(1000)).rates, SizeIs(1));
  EXPECT_THAT(changes(with_others(1200), with_others(1000)).rates, IsEmpty());
}

// If there was no miss before, 11 misses in 10,000 collisions are significant in a single test with the risk
// 0.001. If four tests share this risk, 13 misses are needed for a significant change.
TEST(Changes, AFewAfterNoneAreEnough) {
  const auto with = [](std::uint64_t missed) {
    return campaign("1", {{uniform, counts(20000, 10000, missed, 0)}});
  };
  EXPECT_THAT(changes(with(12), with(0)).rates, IsEmpty());
  const Changes found = changes(with(13), with(0));
  ASSERT_THAT(found.rates, SizeIs(1));
  EXPECT_LT(found.rates[0].p, false_alarm_risk / 4);
}

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
  // The comparison adds up the counts of all families with few failures, once for each of three limits of
  // "few". Then it multiplies the smallest of the three p-values by 3.
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

// The number of false positives has not changed, but now a few of them are far from contact.
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

// For family a, the p-value is 2 / 2^13, which is between 1/5 and 1/4 of the risk. So the change is
// significant among four comparisons, but not if the sum over families is a fifth comparison.
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

// Functions that give the run time of each subject, kind and family as a multiple of the usual run time.

double usual(const CountsKey& /*key*/) { return 1; }

const CountsKey one{"mine", Kind::edge_edge, "f7"};

double one_slower(const CountsKey& key) { return key == one ? 1.5 : 1; }

/// A number from -1 to 1, from a hash of the text.
double noise(const std::string& text) {
  return static_cast<double>(std::hash<std::string>{}(text) % 2001) / 1000 - 1;
}

/// A campaign in which each family's time is `slowness` times the usual time, with a deviation of up to 2 %.
/// Each family has 40 batches, whose times differ from the family's time by up to 20 %.
Campaign night(const std::string& seed, const Slowness& slowness,
               std::vector<std::string> subjects = {"mine", "wang"}, int families = 20) {
  std::map<CountsKey, Counts> all;
  for (const std::string& subject : subjects)
    for (int i = 0; i < families; ++i)
      for (const Kind kind : kinds_of_meshes) {
        const CountsKey key{subject, kind, "f" + std::to_string(i)};
        const std::string name = seed + subject + key.family + std::string(short_name(kind));
        const double ns = 100 * (1 + i) * slowness(key) * (1 + 0.02 * noise(name));
        Counts& counts = all[key];
        counts.queries = 40000;
        for (int batch = 0; batch < 40; ++batch) {
          const double of_batch = ns * (1 + 0.2 * noise(name + std::to_string(batch)));
          counts.times.add(kind, key.family, {1000, static_cast<std::uint64_t>(1000 * of_batch)});
        }
      }
  return campaign(seed, std::move(all));
}

std::vector<ChangedTime> changed(const Campaign& now, const std::vector<Campaign>& before) {
  return compare_times(now, before, false_alarm_risk).changed;
}

TEST(ChangedTimes, EqualNightsHaveNone) {
  const ComparedTimes found =
      compare_times(night("2", usual), std::vector{night("1", usual)}, false_alarm_risk);
  EXPECT_THAT(found.changed, IsEmpty());
  EXPECT_EQ(found.compared, 2 * (2 * 20 + 1));
  EXPECT_EQ(found.campaigns, 1);
}

TEST(ChangedTimes, AFamilyThatIsSlowerIsTold) {
  const Changes found = changes(night("2", one_slower), night("1", usual));
  ASSERT_THAT(found.times.changed, SizeIs(1));
  const ChangedTime& time = found.times.changed[0];
  EXPECT_NEAR(time.ratio(), 1.5, 0.15);
  EXPECT_TRUE(time.slower());
  EXPECT_THAT(describe(found), HasSubstr("slower: mine ee in f7, 1."));
  EXPECT_TRUE(lines_for_the_worse(found).empty());
  const Headline line = headline(night("2", one_slower).statistics, found);
  EXPECT_THAT(line.text, HasSubstr("1 family slower since the baseline"));
  EXPECT_TRUE(line.clean);
  EXPECT_EQ(changes_json(found)["changed_times"][0]["family"], "f7");
}

TEST(ChangedTimes, AFamilyThatIsFasterIsTold) {
  const Changes found = changes(night("2", usual), night("1", one_slower));
  EXPECT_THAT(describe(found), HasSubstr("faster: mine ee in f7, 0.6"));
  EXPECT_THAT(headline(night("2", usual).statistics, found).text,
              HasSubstr("nothing worse since the baseline"));
}

TEST(ChangedTimes, ABusyMachineSaysNothing) {
  const Slowness busy = [](const CountsKey&) { return 1.7; };
  EXPECT_THAT(changed(night("2", busy), {night("1", usual)}), IsEmpty());
  EXPECT_THAT(changed(night("2", busy, {"mine"}), {night("1", usual, {"mine"})}), IsEmpty());
  const Slowness busy_and_one_slower = [](const CountsKey& key) { return 1.7 * one_slower(key); };
  EXPECT_THAT(changed(night("2", busy_and_one_slower), {night("1", usual)}), SizeIs(1));
}

TEST(ChangedTimes, ASubjectThatIsSlowerEverywhereIsToldOnce) {
  const auto slow = [](double factor) {
    return [factor](const CountsKey& key) { return key.subject == "mine" ? factor : 1.0; };
  };
  for (const double factor : {2.0, 118.0, 1 / 118.0}) {
    const auto found = changed(night("2", slow(factor)), {night("1", usual)});
    ASSERT_THAT(found, SizeIs(1)) << factor;
    EXPECT_TRUE(found[0].is_of_subject());
    EXPECT_EQ(found[0].subject, "mine");
    EXPECT_NEAR(found[0].ratio() / factor, 1, 0.05);
  }
  // A subject's families are compared with each other if it has at least eight combinations of family and
  // kind. The next nights have exactly eight: 4 families and 2 kinds.
  const std::vector<std::string> subjects{"mine", "wang"};
  EXPECT_THAT(changed(night("2", slow(3), subjects, 4), {night("1", usual, subjects, 4)}), SizeIs(1));
  const auto alone = changed(night("2", slow(118), {"mine"}), {night("1", usual, {"mine"})});
  ASSERT_THAT(alone, SizeIs(1));
  EXPECT_NEAR(alone[0].ratio() / 118, 1, 0.05);
}

// If a family's times differ by a factor of 1.5 between nights of the baseline, the same factor in the
// present night is no change.
TEST(ChangedTimes, TheNightsOfTheBaselineShowTheSpread) {
  std::vector<Campaign> nights;
  for (int i = 0; i < 8; ++i) nights.push_back(night(std::to_string(i), i % 2 == 0 ? one_slower : usual));
  EXPECT_THAT(changed(night("now", one_slower), nights), IsEmpty());
  EXPECT_THAT(changed(night("now", usual), nights), IsEmpty());
  const auto other =
      changed(night("now", [](const CountsKey& key) { return key.family == "f3" ? 1.5 : 1.0; }), nights);
  EXPECT_THAT(other, SizeIs(4));  // the family f3, for each subject and kind
}

TEST(ChangedTimes, ATimeThatWasUncertainSaysLittle) {
  Campaign before = night("1", usual);
  SubjectTimes& times = before.statistics.counts[one].times;
  times = {};
  // In the later night, each batch takes 800 ns per query.
  for (std::uint64_t batch = 0; batch < 10; ++batch)
    for (const std::uint64_t ns : {160, 1600}) times.add(one.kind, one.family, {1000, ns * (1000 + batch)});
  EXPECT_THAT(changed(night("2", usual), {before}), IsEmpty());
}

// The times of a few families do not show how much the times of families usually vary. So these times are
// compared with the times of other subjects.
TEST(ChangedTimes, OfAFewFamiliesAreComparedWithOtherSubjects) {
  const auto few = [](double factor) {
    return [factor](const CountsKey& key) {
      return key.subject == "mine" && key.kind == Kind::edge_edge ? factor : 1.0;
    };
  };
  const std::vector before{night("1", usual, {"mine", "wang"}, 1)};
  EXPECT_THAT(changed(night("2", few(1.3), {"mine", "wang"}, 1), before), IsEmpty());
  const auto found = changed(night("2", few(3), {"mine", "wang"}, 1), before);
  ASSERT_THAT(found, SizeIs(::testing::Ge(1)));
  EXPECT_EQ(found[0].kind, "ee");
}

// Four families show only roughly how much the times of families usually vary.
TEST(ChangedTimes, OfAFewFamiliesSayLittle) {
  const auto slower = [](double factor) {
    return [factor](const CountsKey& key) {
      return key.subject == "mine" && key.kind == Kind::edge_edge && key.family == "f2" ? factor : 1;
    };
  };
  const std::vector<std::string> subjects{"mine", "wang"};
  const std::vector before{night("1", usual, subjects, 4)};
  EXPECT_THAT(changed(night("2", slower(1.3), subjects, 4), before), IsEmpty());
  EXPECT_THAT(changed(night("2", slower(1.5), subjects, 4), before), SizeIs(1));
}

// The expected numbers are from SciPy. There are two earlier campaigns. Each family has two batches.
TEST(ChangedTimes, AreComparedByWelchsTest) {
  constexpr int last = 8;
  const auto night_of = [](const std::function<std::pair<int, int>(int)>& ns_of) {
    Campaign made = campaign("1", {});
    for (int i = 0; i <= last; ++i) {
      const CountsKey key{"mine", Kind::edge_edge, "f" + std::to_string(i)};
      const auto [fast, slow] = ns_of(i);
      for (const int ns : {fast, slow})
        made.statistics.counts[key].times.add(key.kind, key.family,
                                              {10, 10 * static_cast<std::uint64_t>(ns)});
    }
    return made;
  };
  const std::vector before{night_of([](int) { return std::pair(50, 100); }),
                           night_of([](int i) { return std::pair(60, i == last ? 140 : 110); })};
  const Campaign now =
      night_of([](int i) { return i == last ? std::pair(300, 700) : std::pair(100 + i, 200 + 3 * i); });
  constexpr double any = 1000;  // with so large a risk, every time counts as changed
  const ComparedTimes found = compare_times(now, before, any);
  ASSERT_THAT(found.changed, SizeIs(10));
  EXPECT_EQ(found.compared, 10);
  const auto expect = [](const ChangedTime& time, const std::string& family, double now_ns, double expected,
                         double before_ns, double p) {
    EXPECT_EQ(time.family, family);
    EXPECT_EQ(time.kind, "ee");
    EXPECT_NEAR(time.now, now_ns, 1e-9);
    EXPECT_NEAR(time.expected, expected, 1e-9);
    EXPECT_NEAR(time.before, before_ns, 1e-9);
    EXPECT_NEAR(time.p, p, 1e-9);
  };
  expect(found.changed[0], "all families", 167.3455060391121, 85.4196797754686, 85.4196797754686,
         0.0010529724732505831);
  expect(found.changed[1], "f0", 141.42135623730957, 148.48568954616474, 75.79289311365562,
         0.918215418808471);
  expect(found.changed[9], "f8", 458.2575694955841, 157.71334311073448, 80.5030477585033,
         0.17851038048928758);
}

TEST(ChangedTimes, OfAnotherProcessorAreNotCompared) {
  Campaign before = night("1", usual);
  before.runs[0].shards[0].environment["cpu"] = "another";
  const ComparedTimes found = compare_times(night("2", one_slower), {&before, 1}, false_alarm_risk);
  EXPECT_EQ(found.compared, 0);
  EXPECT_EQ(found.campaigns, 0);
}

}  // namespace
}  // namespace nearmiss
