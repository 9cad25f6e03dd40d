// The comparison of a campaign with its baseline: which ways to fail are new, lasting or gone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "reports/sections/baseline.hpp"
#include "reports/sections/headline.hpp"
#include "reports/text/json.hpp"
#include "tests/refused.hpp"
#include "tests/reports/campaigns.hpp"

namespace nearmiss {
namespace {

using ::nearmiss::testing::campaign;
using ::nearmiss::testing::counts;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using Seen = std::map<Signature, std::uint64_t>;

const CountsKey key{"mine", Kind::edge_edge, "uniform"};

const auto missed = Finding::What::false_negative;
const Signature inside{missed, "mine", "ee inside"};
const Signature on_edge{missed, "mine", "ee on-edge"};

TEST(Changes, TheFirstFailureOfACleanSubjectIsNewAtOnce) {
  Campaign before = campaign("1", {{key, counts(200000, 100000, 0, 0)}});
  Campaign now = before;
  now.statistics.seen[inside] = 1;
  EXPECT_THAT(changes(now, before).new_signatures, SizeIs(1));
  // The failure of `mine` is new, even if another subject failed before, or if `mine` failed before in
  // another way.
  before.statistics.seen[{missed, "basic", "ee inside"}] = 9;
  before.statistics.seen[{Finding::What::refuted_bound, "mine", "ee"}] = 9;
  EXPECT_THAT(changes(now, before).new_signatures, SizeIs(1));
  now.statistics.seen = {{{Finding::What::oracle_disagreement, "", "ee"}, 1}};
  before.statistics.seen[{Finding::What::oracle_disagreement, "", "vt"}] = 1;
  EXPECT_THAT(changes(now, before).new_signatures,
              SizeIs(1));  // a failure of the oracle is new even if it occurs only once
}

TEST(Changes, ARareUnseenSignatureOfAFailingSubjectIsNotNew) {
  Campaign before = campaign("1", {{key, counts(200000, 100000, 50, 0)}});
  Campaign now = before;
  before.statistics.seen = {
      {{missed, "mine", "a"}, 40}, {{missed, "mine", "b"}, 1}, {{missed, "mine", "c"}, 1}};
  now.statistics.seen = {{{missed, "mine", "a"}, 45}, {{missed, "mine", "d"}, 2}};
  const Changes chance = changes(now, before);
  EXPECT_THAT(chance.new_signatures, IsEmpty());
  EXPECT_THAT(chance.unseen_signatures, ElementsAre(Signature{missed, "mine", "d"}));
  // This is the estimate of Good and Toulmin. The earlier campaign has seen each of the signatures b and c
  // once, so each counts 1. The earlier campaign has seen the signature a 40 times, so a counts -1.
  EXPECT_DOUBLE_EQ(chance.expected_unseen, 2 - 1);
  EXPECT_THAT(lines_for_the_worse(chance), IsEmpty());

  now.statistics.seen[{missed, "mine", "d"}] = 20;
  EXPECT_THAT(changes(now, before).new_signatures, ElementsAre(Signature{missed, "mine", "d"}));
  // The signature a is known, but is far more frequent than before.
  now.statistics.seen = {{{missed, "mine", "a"}, 140}};
  EXPECT_THAT(changes(now, before).new_signatures, ElementsAre(Signature{missed, "mine", "a"}));
}

// The statistical test is one-sided: if there are k failures now and there were none before, the p-value is 1
// / 2^k. The risk 0.001 is divided by the number of signatures (ways to fail) in the two campaigns.
TEST(Changes, ASignatureIsComparedAtItsPartOfTheRisk) {
  const auto with = [](Seen seen) {
    Campaign made = campaign("1", {{key, counts(2000000, 1000000, 50, 0)}});
    made.statistics.seen = std::move(seen);
    return made;
  };
  const Signature a{missed, "mine", "a"};
  const Signature b{missed, "mine", "b"};
  const Signature c{missed, "mine", "c"};
  const auto is_new = [&](std::uint64_t times, const Campaign& before) {
    return !changes(with({{a, 40}, {b, times}}), before).new_signatures.empty();
  };
  const Campaign two = with({{a, 40}});
  EXPECT_FALSE(is_new(10, two));
  EXPECT_TRUE(is_new(11, two));
  const Campaign three = with({{a, 40}, {c, 1}});  // c no longer occurs, but is also compared
  EXPECT_FALSE(is_new(11, three));
  EXPECT_TRUE(is_new(12, three));
}

/// A campaign that began at `date`, with a version of the plug-in `mine`.
Campaign night(const std::string& date, Seen seen, const std::string& version = "1",
               const std::string& sha256 = "a", std::uint64_t queries = 200000) {
  Campaign made = campaign(date, {{key, counts(queries, queries / 2, 0, 0)}});
  made.runs[0].shards[0].started = date;
  made.runs[0].info["plug-in mine version"] = version;
  made.runs[0].info["plug-in mine sha256"] = sha256 + "0123456789abcdef";
  made.statistics.seen = std::move(seen);
  return made;
}

// The failure is seen about 1,000 times in four of five nightly campaigns, and not at all in the third one.
// Chance explains 1,005 failures in a sixth campaign, but not 1,300.
TEST(Baseline, AFailureThatWasAbsentOnceIsNotNewAgain) {
  const auto misses = [](std::uint64_t times) {
    Campaign made = campaign(std::to_string(times), {{key, counts(200000, 100000, times, 0)}});
    made.statistics.seen = {{on_edge, 1}};
    if (times != 0) made.statistics.seen[inside] = times;
    return made;
  };
  std::vector<Campaign> nights{misses(1001), misses(1002), misses(0), misses(1003), misses(1004)};
  const Changes found = changes(misses(1005), nights);
  EXPECT_THAT(found.new_signatures, IsEmpty());
  EXPECT_THAT(found.rates, IsEmpty());
  EXPECT_THAT(changes(misses(1300), nights).new_signatures, ElementsAre(inside));
  EXPECT_THAT(changes(misses(1300), nights).rates, SizeIs(1));
  // If the fourth night has the failure only once, the third night stays in the baseline.
  nights.resize(3);
  nights.push_back(misses(1));
  EXPECT_THAT(changes(misses(2000), nights).new_signatures, ElementsAre(inside));
}

// In the baseline, one of 1,000 random draws fails; now, five fail. The 12 steps of a sweep (values of a
// family's parameter) share their draws, so all steps fail with the same draws. But each of 12 families has
// its own draws.
TEST(Changes, StepsOfASweepShareTheirDraws) {
  const auto with = [](const std::string& family, std::uint64_t draws) {
    constexpr std::uint64_t steps = 12;
    std::map<CountsKey, Counts> all;
    for (std::uint64_t i = 0; i < steps; ++i)
      all[{"basic", Kind::edge_edge, family + std::to_string(i)}] = counts(10000, 1000, draws, 0);
    Campaign made = campaign(std::to_string(draws), std::move(all));
    made.statistics.seen[{missed, "basic", "ee inside"}] = steps * draws;
    return made;
  };
  const Changes sweep = changes(with("scale@", 5), with("scale@", 1));
  EXPECT_THAT(sweep.new_signatures, IsEmpty());
  EXPECT_THAT(sweep.rates, IsEmpty());
  const Changes families = changes(with("scale", 5), with("scale", 1));
  EXPECT_THAT(families.new_signatures, SizeIs(1));
  EXPECT_THAT(families.rates, SizeIs(1));
}

TEST(Baseline, RatesAreComparedWithTheSum) {
  const auto with = [](const std::string& seed, std::uint64_t false_positives) {
    return campaign(seed, {{key, counts(200000, 100000, 0, false_positives)}});
  };
  const Campaign now = with("now", 1690);
  EXPECT_THAT(changes(now, with("1", 1500)).rates, IsEmpty());
  const Changes found = changes(now, std::vector{with("1", 1500), with("2", 1500), with("3", 1500)});
  ASSERT_THAT(found.rates, SizeIs(1));
  EXPECT_EQ(found.rates[0].before.count, 4500);
  EXPECT_EQ(found.rates[0].before.total, 300000);
}

TEST(Baseline, RandomQueriesCountOnce) {
  const Campaign once = night("1", {});
  EXPECT_REFUSED(add_up(std::vector{once, once}), "shard 0/1 of the run with seed 1 twice");
  Campaign replay = once;  // a replay asks the same cases every time
  replay.runs[0].info = {{"command", "replay"}};
  EXPECT_EQ(add_up(std::vector{replay, replay}).statistics.queries_of("mine"), 400000);
}

TEST(Baseline, KnowsWhenEachSignatureWasSeen) {
  const std::vector<Campaign> nights{night("2026-01-01", {{inside, 1}}), night("2026-01-02", {}),
                                     night("2026-01-03", {{inside, 2}, {on_edge, 1}}),
                                     night("2026-01-04", {})};
  const Changes found = changes(night("2026-01-05", {{inside, 1}}), nights);
  const SubjectCode code{"1", "sha256 a0123456789a"};
  EXPECT_EQ(found.sightings.at(inside), (Sightings{"2026-01-01", "2026-01-03", 2, code, code}));
  EXPECT_EQ(found.sightings.at(on_edge), (Sightings{"2026-01-03", "2026-01-03", 1, code, code}));
  EXPECT_THAT(found.new_signatures, IsEmpty());
  EXPECT_THAT(found.lasting_signatures, ElementsAre(inside));
  EXPECT_THAT(found.unrepeated_signatures, ElementsAre(on_edge));
  EXPECT_EQ(describe(found, true),
            "lasting: false-negative of mine, ee inside, first seen 2026-01-01 (version 1), "
            "last seen 2026-01-03 (version 1)\n");
  const auto json = changes_json(found);
  EXPECT_EQ(json["lasting_signatures"][0]["first_seen"], "2026-01-01");
  EXPECT_EQ(json["lasting_signatures"][0]["last_seen"], "2026-01-03");
  EXPECT_EQ(json["lasting_signatures"][0]["campaigns"], 2);
  EXPECT_EQ(json["unrepeated_signatures"][0]["first_seen"], "2026-01-03");
}

TEST(Baseline, SaysHowOftenEachSubjectFailsAsBefore) {
  const Signature of_oracle{Finding::What::oracle_disagreement, "", "vt x"};
  const std::vector<Campaign> nights{night("2026-01-02", {{on_edge, 9}, {of_oracle, 1}}),
                                     night("2026-01-03", {{inside, 9}})};
  EXPECT_EQ(describe(changes(night("2026-01-04", {{inside, 9}, {on_edge, 9}, {of_oracle, 1}}), nights)),
            "lasting: 1 way to fail of the oracle, the oldest first seen 2026-01-02\n"
            "lasting: 2 ways to fail of mine, the oldest first seen 2026-01-02 (version 1)\n");
}

TEST(Baseline, SaysManyChangesOfASubjectInOneLine) {
  const Changes found = changes(night("2026-01-02", {{inside, 9}, {on_edge, 9}}), night("2026-01-01", {}));
  EXPECT_EQ(describe(found), "new: 2 ways to fail of mine, such as false-negative of mine, ee inside\n");
  EXPECT_EQ(describe(found, true),
            "new: false-negative of mine, ee inside\nnew: false-negative of mine, ee on-edge\n");
}

TEST(Baseline, AFailureIsNewOnceAndThenLasts) {
  std::vector<Campaign> nights{night("1", {})};
  const Changes first = changes(night("2", {{inside, 1}}), nights);
  EXPECT_THAT(first.new_signatures, ElementsAre(inside));
  EXPECT_THAT(first.lasting_signatures, IsEmpty());
  EXPECT_THAT(lines_for_the_worse(first), SizeIs(1));
  nights.push_back(night("2", {{inside, 1}}));
  nights.push_back(night("3", {}));
  const Changes later = changes(night("4", {{inside, 1}}), nights);
  EXPECT_THAT(later.new_signatures, IsEmpty());
  EXPECT_THAT(later.lasting_signatures, ElementsAre(inside));
  EXPECT_THAT(lines_for_the_worse(later), IsEmpty());
}

TEST(Baseline, ASubjectThatItLacksHasNoNewWayToFail) {
  const Campaign before = night("1", {});
  Campaign now = night("2", {});
  now.statistics.counts[{"yours", Kind::edge_edge, "uniform"}] = counts(2000, 1000, 7, 0);
  now.statistics.seen[{missed, "yours", "ee inside"}] = 7;
  const Changes found = changes(now, before);
  EXPECT_THAT(found.absent_subjects, ElementsAre("yours"));
  EXPECT_THAT(found.new_signatures, IsEmpty());
  EXPECT_THAT(lines_for_the_worse(found), IsEmpty());
  EXPECT_EQ(describe(found), "not in the baseline: yours\n");
  EXPECT_EQ(changes_json(found)["absent_subjects"][0], "yours");
}

TEST(Baseline, ManyValuesOfAFactAreCounted) {
  std::vector<Campaign> nights;
  for (int i = 0; i < 7; ++i) nights.push_back(night(std::to_string(i), {}));
  const Changes found = changes(night("now", {}), nights);
  ASSERT_THAT(found.facts, SizeIs(1));
  EXPECT_EQ(found.facts[0].before, "7 values");
  EXPECT_EQ(found.facts[0].now, "now");
}

TEST(Gone, IsWhatChanceWouldHardlyHide) {
  const Changes found = changes(night("2", {{on_edge, 20}}), night("1", {{inside, 40}, {on_edge, 20}}));
  EXPECT_THAT(found.gone_signatures, ElementsAre(inside));
  EXPECT_EQ(describe(found),
            "lasting: 1 way to fail of mine, the oldest first seen 1 (version 1)\n"
            "gone: false-negative of mine, ee inside, first seen 1 (version 1), last seen 1 (version 1)\n");
  EXPECT_THAT(headline({}, found).text, HasSubstr("1 way to fail is gone"));
  const Changes chance = changes(night("2", {{on_edge, 20}}), night("1", {{inside, 4}, {on_edge, 20}}));
  EXPECT_THAT(chance.gone_signatures, IsEmpty());
  EXPECT_THAT(chance.unrepeated_signatures, ElementsAre(inside));
}

// Chance could explain that any single one of the 30 failures is absent, but hardly that all of them are
// absent.
TEST(Gone, AreTheRareFailuresOfASubjectThatFailsNoMore) {
  Seen rare;
  for (int i = 0; i < 30; ++i) rare[{missed, "mine", "way " + std::to_string(i)}] = 1;
  EXPECT_EQ(changes(night("2", {}), night("1", rare)).gone_signatures.size(), 30);
  EXPECT_THAT(changes(night("2", {{inside, 1}}), night("1", rare)).gone_signatures, IsEmpty());
}

// If all failures may come from the family `parallel`, and the later campaign asks twice as many queries of
// this family, then twice as many failures are no change.
TEST(New, ASignatureIsOnlyIfItsFamilyDoesNotExplainIt) {
  const auto night_of = [](const std::string& date, std::uint64_t queries, std::uint64_t seen) {
    Campaign made = night(date, {{inside, seen}});
    made.statistics.counts[{"mine", Kind::edge_edge, "parallel"}] = counts(queries, queries / 2, 0, 0);
    return made;
  };
  const Campaign before = night_of("1", 1000, 100);
  EXPECT_THAT(changes(night_of("2", 2000, 200), before).new_signatures, IsEmpty());
  EXPECT_THAT(changes(night_of("2", 1000, 200), before).new_signatures, ElementsAre(inside));
}

TEST(Gone, NeedsTheQueriesOfEveryFamily) {
  const Campaign before = night("1", {{inside, 40}});
  EXPECT_THAT(changes(night("2", {}, "1", "a", 20000), before).gone_signatures, IsEmpty());
  Campaign other = night("2", {});
  other.statistics.counts = {{{"mine", Kind::edge_edge, "parallel"}, counts(200000, 100000, 0, 0)}};
  EXPECT_THAT(changes(other, before).gone_signatures, IsEmpty());
  Campaign crashes = night("2", {});
  crashes.statistics.counts[key].faults[static_cast<std::size_t>(Fault::crash)] = 100000;
  crashes.statistics.counts[key].collisions = 0;
  EXPECT_THAT(changes(crashes, before).gone_signatures, ElementsAre(inside));
  crashes.statistics.counts[key].faults[static_cast<std::size_t>(Fault::crash)] = 199000;
  EXPECT_THAT(changes(crashes, before).gone_signatures, IsEmpty());
}

// Each signature had 40 failures. 38 of them occurred in cases of the corpus, which the later campaign does
// not replay.
TEST(Gone, DoesNotCountFailuresInCases) {
  const Signature late{Finding::What::late, "mine", "ee inside"};
  const Signature crash{Finding::What::fault, "mine", "ee crash"};
  Campaign before = night("1", {{inside, 40}, {late, 40}, {crash, 40}});
  Counts& cases = before.statistics.counts[{"mine", Kind::edge_edge, "planar/"}];
  cases = counts(50, 50, 38, 0);
  cases.late = 38;
  cases.faults[static_cast<std::size_t>(Fault::crash)] = 38;
  EXPECT_THAT(changes(night("2", {}), before).gone_signatures, IsEmpty());
  cases.faults = {};
  cases.faults[static_cast<std::size_t>(Fault::not_asked)] = 40;
  EXPECT_THAT(changes(night("2", {}), before).gone_signatures, ElementsAre(crash));
}

TEST(Gone, IsFixedIfTheCodeHasChanged) {
  const std::vector before{night("1", {{inside, 40}}, "1", "a"), night("2", {{inside, 30}}, "2", "b")};
  const auto text = [&](const std::string& version, const std::string& sha256) {
    return describe(changes(night("3", {}, version, sha256), before));
  };
  const std::string seen =
      ": false-negative of mine, ee inside, first seen 1 (version 1), last seen 2 (version 2)\n";
  EXPECT_EQ(text("3", "c"), "fixed in version 3" + seen);
  EXPECT_EQ(text("2", "c"), "fixed since sha256 c0123456789a" + seen);
  EXPECT_EQ(text("2", "b"), "gone" + seen);
  const auto json = changes_json(changes(night("3", {}, "3", "c"), before));
  EXPECT_EQ(json["gone_signatures"][0]["fixed"], "in version 3");
  EXPECT_EQ(json["gone_signatures"][0]["first_code"], "version 1");
  EXPECT_EQ(json["gone_signatures"][0]["last_code"], "version 2");
  // The fix is in the first version without the signature (3), not in the version of this campaign (4).
  auto nights = before;
  nights.push_back(night("3", {}, "2", "b"));
  nights.push_back(night("4", {}, "3", "c"));
  EXPECT_THAT(describe(changes(night("5", {}, "4", "d"), nights)), HasSubstr("fixed in version 3: "));
}

TEST(Gone, OfABuiltInSubjectIsFixedInAVersionOfNearmiss) {
  Campaign before = night("1", {{inside, 40}});
  before.runs[0].info = {{"version", "0.1"}, {"commit", "abc"}};
  Campaign now = night("2", {});
  now.runs[0].info = {{"version", "0.1"}, {"commit", "def"}};
  EXPECT_THAT(describe(changes(now, before)), HasSubstr("fixed since commit def: "));
  EXPECT_EQ(code_of(now, "mine"), (SubjectCode{"0.1", "commit def"}));
}

}  // namespace
}  // namespace nearmiss
