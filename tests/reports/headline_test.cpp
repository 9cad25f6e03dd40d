// The headline: the verdict in one line, and the alarms.
#include "reports/sections/headline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/reports/campaigns.hpp"

namespace nearmiss {
namespace {

using ::nearmiss::testing::campaign;
using ::nearmiss::testing::counts;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(Headline, SaysWhoFailedAndWhetherAnythingIsNew) {
  const Campaign good = campaign("1", {{{"a", Kind::edge_edge, "f"}, counts(9, 5, 0, 0)},
                                       {{"b", Kind::edge_edge, "f"}, counts(9, 5, 0, 0)}});
  EXPECT_EQ(headline(good.statistics, std::nullopt).text, "a and b did not fail.");
  EXPECT_TRUE(headline(good.statistics, std::nullopt).clean);

  Campaign bad = good;
  bad.statistics.counts.begin()->second.false_negatives = 1;
  bad.statistics.seen[{Finding::What::false_negative, "a", "ee"}] = 1;
  bad.statistics.oracle[{Kind::edge_edge, "f"}].queries = 1234;
  const std::string who = "a failed: it missed 1 of 5 ee collisions; b did not fail, in 1,234 queries";
  EXPECT_EQ(headline(bad.statistics, std::nullopt).text, who + ".");
  EXPECT_FALSE(headline(bad.statistics, std::nullopt).clean);
  EXPECT_EQ(headline(bad.statistics, changes(bad, good)).text,
            who + "; 1 new way to fail since the baseline.");
  EXPECT_FALSE(headline(bad.statistics, changes(bad, good)).clean);
  EXPECT_EQ(headline(bad.statistics, changes(bad, bad)).text,
            who + "; 1 way to fail as before, nothing worse since the baseline.");
  EXPECT_FALSE(headline(bad.statistics, changes(bad, bad)).clean);

  bad.statistics.oracle_disagreements = 2;
  EXPECT_THAT(headline(bad.statistics, changes(bad, bad)).text,
              HasSubstr("The oracle cannot be trusted: 2 "));
  EXPECT_FALSE(headline(bad.statistics, changes(bad, bad)).clean);
}

TEST(Headline, NamesTheLeastExoticClassInWhichASubjectFailed) {
  Statistics of;
  of.counts[{"a", Kind::edge_edge, "scale"}] = counts(99, 90, 80, 0);
  of.counts[{"a", Kind::edge_edge, "uniform"}] = counts(9, 5, 0, 0);
  of.counts[{"a", Kind::vertex_triangle, "uniform"}] = counts(9, 5, 2, 0);
  of.counts[{"b", Kind::vertex_triangle, "uniform"}] = counts(9, 5, 0, 0);
  EXPECT_EQ(headline(of, std::nullopt).text,
            "a failed: it missed 2 of 5 ordinary vt collisions; b did not fail.");
  of.counts[{"b", Kind::vertex_triangle, "planar"}] = counts(9, 5, 1, 0);
  of.counts[{"c", Kind::vertex_triangle, "uniform"}] = counts(9, 5, 1, 0);
  EXPECT_EQ(headline(of, std::nullopt).text, "a and c failed ordinary queries; b failed degenerate queries.");
}

TEST(Headline, ASubjectOfWhichNothingWasAskedHasNotPassed) {
  Statistics of;
  of.counts[{"a", Kind::vertex_triangle, "uniform"}] = counts(9, 5, 0, 0);
  of.counts[{"b", Kind::vertex_triangle, "uniform"}] = {};
  EXPECT_EQ(headline(of, std::nullopt).text, "b was asked nothing; a did not fail.");
  EXPECT_FALSE(headline(of, std::nullopt).clean);
}

// A fault that lasts raises an alarm only in its first night; a broken promise raises one in every night.
TEST(Headline, AlarmsWhileAPromiseIsBrokenAndOnceAboutWhatLasts) {
  const CountsKey key{"a", Kind::vertex_triangle, "uniform"};
  const Campaign good = campaign("1", {{key, counts(9, 5, 0, 0)}});
  const auto alarms = [](const Campaign& now, const Campaign& before) {
    return headline(now.statistics, changes(now, before)).alarms;
  };
  Campaign crashing = good;
  crashing.statistics.counts[key].faults[static_cast<std::size_t>(Fault::crash)] = 2;
  EXPECT_THAT(alarms(good, good), IsEmpty());
  EXPECT_THAT(alarms(crashing, good), ElementsAre("a failed to answer 2 of 9 ordinary vt queries"));
  EXPECT_THAT(alarms(crashing, crashing), IsEmpty());
  EXPECT_FALSE(headline(crashing.statistics, changes(crashing, crashing)).clean);
  Campaign missing = crashing;
  missing.statistics.counts[key].false_negatives = 1;
  EXPECT_THAT(alarms(missing, missing), ElementsAre("a missed 1 of 5 ordinary vt collisions"));
  // Every failure of a subject that the baseline lacks raises an alarm.
  EXPECT_THAT(alarms(crashing, campaign("2", {})), SizeIs(1));
  // A failure that counts only on request raises an alarm only on request.
  Campaign slow = good;
  slow.statistics.counts[key].faults[static_cast<std::size_t>(Fault::time)] = 2;
  slow.statistics.seen[{Finding::What::fault, "a", "vt time"}] = 2;
  EXPECT_THAT(alarms(slow, good), IsEmpty());
  EXPECT_THAT(headline(slow.statistics, changes(slow, good), all_failures()).alarms, SizeIs(2));
}

TEST(Headline, NothingBeyondAContractAlarmsOrIsWorse) {
  const CountsKey within{"a", Kind::edge_edge, "uniform"};
  const CountsKey beyond{"a (beyond contract)", Kind::edge_edge, "uniform"};
  const Campaign good = campaign("1", {{within, counts(9, 5, 0, 0)}, {beyond, counts(9000, 5000, 0, 0)}});
  Campaign bad = good;
  bad.statistics.counts[beyond].false_negatives = 5000;
  bad.statistics.seen[{Finding::What::false_negative, beyond.subject, "ee"}] = 5000;
  for (const auto& [now, before] : {std::pair(bad, good), {good, bad}, {bad, bad}}) {
    const Headline line = headline(now.statistics, changes(now, before));
    EXPECT_TRUE(line.clean);
    EXPECT_THAT(line.alarms, IsEmpty());
    EXPECT_EQ(line.text, "a did not fail; nothing worse since the baseline.");
  }
}

TEST(Headline, SaysThatThereIsNothingToCompareOrToJudge) {
  const Campaign before = campaign("1", {{{"a", Kind::edge_edge, "f"}, counts(9, 5, 0, 0)}});
  const Campaign now = campaign("2", {{{"b", Kind::edge_edge, "f"}, counts(9, 5, 0, 0)}});
  EXPECT_EQ(headline(now.statistics, changes(now, before)).text,
            "b did not fail; no subject is in the baseline.");
  EXPECT_EQ(headline({}, std::nullopt).text, "No subject was asked.");
}

TEST(Headline, CountsSubjectsWhereThereAreMany) {
  Campaign many = campaign("1", {});
  for (char name = 'a'; name < 'k'; ++name)
    many.statistics.counts[{std::string(1, name), Kind::edge_edge, "f"}] = counts(9, 5, 0, 0);
  many.statistics.counts.begin()->second.false_negatives = 1;
  EXPECT_EQ(headline(many.statistics, std::nullopt).text,
            "a failed: it missed 1 of 5 ee collisions; 9 subjects did not fail.");
}

}  // namespace
}  // namespace nearmiss
