// The list of small queries, and the search for a failure in this list.
#include "fuzz/trial/small_queries.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <span>

#include "fuzz/families/classify.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/trial/judge.hpp"
#include "fuzz/trial/shrunk_finding.hpp"
#include "oracle/oracle.hpp"
#include "tests/fuzz/made_up_subjects.hpp"

namespace nearmiss {
namespace {

/// Expects that a list is sorted, and that exact arithmetic agrees with the truth of one query in `one_in`.
void expect_sorted_and_decided(const std::vector<SmallQuery>& list, std::size_t one_in) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i > 0) {
      EXPECT_FALSE(list[i].complexity < list[i - 1].complexity);
    }
    if (i % one_in != 0) continue;
    const Decision exactly = decide_exactly(list[i].query);
    EXPECT_EQ(list[i].collision, exactly.collision);
    EXPECT_FALSE(exactly.is_tie);
  }
}

TEST(SmallQueries, AreSortedAndDecided) {
  for (const Kind kind : kinds_of_meshes) {
    const auto& list = small_queries(kind);
    EXPECT_EQ(list.size(), kind == Kind::vertex_triangle ? 5995 : 5372);  // without symmetric copies
    EXPECT_EQ(list.front().query, Query{.kind = kind});
    expect_sorted_and_decided(list, 61);
    for (const SmallQuery& each : list) {
      EXPECT_EQ(each.query.kind, kind);
      EXPECT_EQ(each.complexity.awkward, 0);
    }
    const auto collisions =
        std::count_if(list.begin(), list.end(), [](const SmallQuery& q) { return q.collision; });
    EXPECT_GT(collisions, 1000);
    EXPECT_LT(collisions, static_cast<std::ptrdiff_t>(list.size()) - 1000);
  }
}

TEST(SmallQueries, HaveFourSeparationsIfThereIsOne) {
  for (const Kind kind : kinds_of_meshes) {
    const auto& list = small_queries(kind, true);
    expect_sorted_and_decided(list, 301);
    std::map<double, std::size_t> seen;
    for (const SmallQuery& each : list) ++seen[each.query.separation];
    ASSERT_EQ(seen.size(), 4);
    for (const double h : {0.25, 0.5, 1.0, 2.0}) EXPECT_GT(seen[h], small_queries(kind).size() / 2) << h;
    // The list leaves out queries with two right answers.
    EXPECT_LT(list.size(), 4 * small_queries(kind).size());
  }
}

const testing::MadeUpSubject blind("blind", [](const Query&) { return Verdict{}; });

Finding missed(Kind kind) {
  Finding finding{
      .what = Finding::What::false_negative, .subject = "blind", .family = {}, .query = {}, .provenance = {}};
  finding.query.kind = kind;
  for (std::size_t i = 0; i < 24; ++i) finding.query.x[i] = 1 / (3.0 + static_cast<double>(i));
  return finding;
}

TEST(SmallQueries, GiveTheSimplestFailureOfEachKindAndClass) {
  const Judge judge(blind);
  for (const Kind kind : kinds_of_meshes) {
    const SmallFailures failures(blind, kind, false, [] {});
    for (const QueryClass of : {QueryClass::ordinary, QueryClass::degenerate}) {
      const auto& list = small_queries(kind);
      const auto first = std::find_if(list.begin(), list.end(), [&](const SmallQuery& each) {
        return each.collision && each.complexity.moving >= 3 && classify(each.query) == of;
      });
      ASSERT_NE(first, list.end());
      const auto failure = judge.failure(first->query);
      const auto found = failures.simplest(*failure, NoMoreExotic{of, 3});
      ASSERT_TRUE(found);
      EXPECT_EQ(judge.failure(found->query), failure);
      EXPECT_EQ(name(classify(found->query)), name(of));
      EXPECT_FALSE(first->complexity < found->complexity);
      EXPECT_FALSE(found->complexity < failures.simplest(*failure)->complexity);
    }
    EXPECT_FALSE(failures.simplest({Finding::What::false_negative, "another"}));
  }
}

TEST(SmallQueries, AreLeftIfTooManyProcessesEnd) {
  std::atomic<std::size_t> asked = 0;
  const testing::MadeUpSubject crashing("blind", [&](const Query&) {
    ++asked;
    return Verdict{.fault = Fault::crash};
  });
  EXPECT_EQ(shrunk_query(missed(Kind::edge_edge), &crashing, Stop::never(), limits_in_campaign),
            missed(Kind::edge_edge).query);
  // The shrinker asks batches of 1 to 32 queries, and gives up after 63 faulty answers. It also asks the
  // query of the finding.
  EXPECT_EQ(asked, 1 + 2 + 4 + 8 + 16 + 32 + 1);
}

TEST(SmallQueries, AreWhatASubjectThatMissesAKindOfContactIsShownWith) {
  const Judge judge(blind);
  for (const Kind kind : kinds_of_meshes)
    for (std::uint64_t i = static_cast<std::uint64_t>(kind); i < 24; i += 2) {
      const Query query = make_query(find_family("planted"), 1, i);
      const auto failure = judge.failure(query);
      if (!failure || failure->what != Finding::What::false_negative) continue;
      Finding finding = missed(kind);
      finding.query = query;
      finding.signature = failure->signature;
      const Query shrunk = shrunk_query(finding, &blind);
      EXPECT_EQ(complexity(shrunk).awkward, 0) << failure->signature;
      EXPECT_EQ(judge.failure(shrunk), failure);
    }
}

}  // namespace
}  // namespace nearmiss
