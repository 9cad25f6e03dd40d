// The verdict in a line.
#include "reports/sections/headline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/reports/campaigns.hpp"

namespace nearmiss {
namespace {

using ::nearmiss::testing::campaign;
using ::nearmiss::testing::counts;
using ::testing::HasSubstr;

TEST(Headline, SaysWhoFailedAndWhetherAnythingIsNew) {
  const Campaign good = campaign("1", {{{"a", Kind::edge_edge, "f"}, counts(9, 5, 0, 0)},
                                       {{"b", Kind::edge_edge, "f"}, counts(9, 5, 0, 0)}});
  EXPECT_EQ(headline(good.statistics, std::nullopt).text, "a and b did not fail.");
  EXPECT_TRUE(headline(good.statistics, std::nullopt).clean);

  Campaign bad = good;
  bad.statistics.counts.begin()->second.false_negatives = 1;
  bad.statistics.oracle[{Kind::edge_edge, "f"}].queries = 1234;
  EXPECT_EQ(headline(bad.statistics, std::nullopt).text, "a failed; b did not fail, in 1,234 queries.");
  EXPECT_FALSE(headline(bad.statistics, std::nullopt).clean);
  // A failure that the baseline has too is not new.
  EXPECT_EQ(headline(bad.statistics, changes(bad, bad)).text,
            "a failed; b did not fail, in 1,234 queries; nothing worse since the baseline.");
  EXPECT_TRUE(headline(bad.statistics, changes(bad, bad)).clean);
  bad.statistics.seen[{Finding::What::false_negative, "a", "ee"}] = 1;
  EXPECT_THAT(headline(bad.statistics, changes(bad, good)).text,
              HasSubstr("; 1 new way to fail since the baseline."));
  EXPECT_FALSE(headline(bad.statistics, changes(bad, good)).clean);

  EXPECT_EQ(headline(bad.statistics, changes(bad, bad)).text,
            "a failed; b did not fail, in 1,234 queries; 1 way to fail as before, nothing worse since the "
            "baseline.");
  EXPECT_FALSE(headline(bad.statistics, changes(bad, bad)).clean);

  bad.statistics.oracle_disagreements = 2;
  EXPECT_THAT(headline(bad.statistics, changes(bad, bad)).text,
              HasSubstr("The oracle cannot be trusted: 2 "));
  EXPECT_FALSE(headline(bad.statistics, changes(bad, bad)).clean);
}

TEST(Headline, ASubjectThatTheBaselineLacksIsBadIfItFails) {
  const Campaign before = campaign("1", {{{"a", Kind::edge_edge, "f"}, counts(9, 5, 0, 0)}});
  Campaign now = before;
  now.statistics.counts[{"b", Kind::edge_edge, "f"}] = counts(9, 5, 0, 0);
  EXPECT_TRUE(headline(now.statistics, changes(now, before)).clean);
  now.statistics.counts[{"b", Kind::edge_edge, "f"}].false_negatives = 1;
  EXPECT_FALSE(headline(now.statistics, changes(now, before)).clean);
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
  EXPECT_EQ(headline(many.statistics, std::nullopt).text, "a failed; 9 subjects did not fail.");
}

}  // namespace
}  // namespace nearmiss
