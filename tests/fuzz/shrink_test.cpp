// Shrinking makes a query simpler, and the query still fails in the same way.
#include "fuzz/trial/shrink.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "fuzz/families/classify.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/trial/judge.hpp"
#include "fuzz/trial/shrunk_finding.hpp"
#include "reports/campaign/complexity.hpp"
#include "tests/bit_hash.hpp"
#include "tests/fuzz/made_up_subjects.hpp"

namespace nearmiss {
namespace {

using testing::MadeUpSubject;
using testing::WatchedSubject;

/// The result of shrinking a query. A query counts as failing if `fails` returns true for it.
Query shrunk_while(const Query& query, const std::function<bool(const Query&)>& fails) {
  return nearmiss::shrunk(query, [&](std::span<const Query> queries) -> std::optional<std::size_t> {
    const auto first = std::find_if(queries.begin(), queries.end(), fails);
    if (first == queries.end()) return std::nullopt;
    return first - queries.begin();
  });
}

/// For every family and kind, the first query that basic misses.
std::vector<Finding> missed_by_basic() {
  const auto basic = make_subject("basic");
  const Judge judge(*basic);
  std::vector<Finding> missed;
  for (const Family& family : families())
    for (const Kind kind : kinds_of_meshes)
      for (std::uint64_t i = static_cast<std::uint64_t>(kind); i < 2000; i += 2) {
        const Query query = make_query(family, 1, i);
        const auto failure = judge.failure(query);
        if (!failure || failure->what != Finding::What::false_negative) continue;
        missed.push_back({Finding::What::false_negative, "basic", std::string(family.name), query,
                          std::string(family.name) + ":1:" + std::to_string(i), 0, failure->signature,
                          query});
        break;
      }
  return missed;
}

TEST(Shrink, QueriesThatBasicMissesBecomeSimple) {
  const auto basic = make_subject("basic");
  const auto missed = missed_by_basic();
  ASSERT_GE(missed.size(), 17);
  std::vector<int> distinct;
  testing::BitHash hash;
  for (const Finding& finding : missed) {
    const Query shrunk = shrunk_query(finding, basic.get());
    const Complexity after = complexity(shrunk);
    EXPECT_EQ(Judge(*basic).failure(shrunk), (Failure{finding.what, finding.signature}))
        << finding.provenance;
    EXPECT_EQ(shrunk.kind, finding.query.kind);
    EXPECT_FALSE(complexity(finding.query) < after);
    Finding again = finding;
    again.query = shrunk;
    // A second shrinking finds no simpler query.
    EXPECT_EQ(shrunk_query(again, basic.get()), shrunk) << finding.provenance;
    distinct.push_back(after.distinct);
    hash.add_all(shrunk.x);
  }
  EXPECT_EQ(hash.value(), 0x42897e50a3c443da)
      << std::hex << hash.value();  // the shrunk queries are the same as when this hash was recorded
  std::sort(distinct.begin(), distinct.end());
  EXPECT_LE(distinct[distinct.size() / 2],
            // After shrinking, most queries have few distinct numbers. Before shrinking, all queries except
            // coplanar ones have about 20.
            4);
}

TEST(Shrink, KeepsOnlyWhatMatters) {
  const Query query = make_query(find_family("uniform"), 1, 0);
  ASSERT_GT(query.x[3], 0.25);
  const Query shrunk = shrunk_while(query, [](const Query& q) { return q.x[3] > 0.25; });
  Query expected{.kind = query.kind};
  expected.x[3] = expected.x[12 + 3] = 1;  // x1 stays at (1, 0, 0), the others at the origin
  EXPECT_EQ(shrunk, expected);
}

TEST(Shrink, SimplifiesTheSeparation) {
  const Query query = with_separation(make_query(find_family("uniform"), 1, 0), 0.1234);
  const auto separation = [&](double least, double most) {
    const auto fails = [&](const Query& q) { return least <= q.separation && q.separation <= most; };
    return shrunk_while(query, fails).separation;
  };
  EXPECT_EQ(separation(0, 1), 0);
  EXPECT_EQ(separation(1e-300, 10), 1);
  EXPECT_EQ(separation(0.12, 0.6), 0.5);
  EXPECT_EQ(separation(0.12, 0.3), 0.25);
  EXPECT_EQ(separation(0.12, 0.13), 0.125);
}

TEST(Shrink, ScalesTheSeparationWithTheCoordinates) {
  Query query = with_separation(make_query(find_family("uniform"), 1, 0), 0.35);
  query.x[3] = 0.7;
  const Query shrunk =
      shrunk_while(query, [](const Query& q) { return q.separation > 0 && q.x[3] == 2 * q.separation; });
  Query expected = with_separation({.kind = query.kind}, 1);
  expected.x[3] = expected.x[12 + 3] = 2;
  EXPECT_EQ(shrunk, expected);
}

// The subject reports every query, with t = 1/2 as a lower bound of the time of impact.
TEST(Shrink, ALateTimeStaysLate) {
  const MadeUpSubject half("half", [](const Query&) { return Verdict::accepted(Stage::unspecified, 0.5); },
                           {.bound = std::numeric_limits<double>::infinity(),
                            .claims_bound = false,
                            .time_sort = TimeSort::lower_bound,
                            .takes_separation = true});
  const Judge judge(half);
  int late = 0;
  for (const char* family : {"uniform", "planted", "uniform~0.1", "uniform~1e-3"})
    for (std::uint64_t i = 0; i < 10; ++i) {
      const Query query = make_query(find_family(family), 1, i);
      const auto failure = judge.failure(query);
      if (!failure) continue;
      EXPECT_EQ(failure->what, Finding::What::late);
      const Finding finding{failure->what, "half", family, query, "", 0, failure->signature, query};
      const Query shrunk = shrunk_query(finding, &half, Stop::never(), limits_in_campaign);
      EXPECT_EQ(judge.failure(shrunk), failure) << family << " " << i;
      EXPECT_EQ(shrunk.separation > 0, query.separation > 0);
      EXPECT_EQ(complexity(shrunk).awkward, 0) << failure->signature;
      ++late;
    }
  EXPECT_GT(late, 4);
}

TEST(Shrink, KeepsTheClassOfAFinding) {
  const auto basic = make_subject("basic");
  int changed = 0;
  for (Finding finding : missed_by_basic()) {
    const Query simplest = shrunk_query(finding, basic.get());
    finding.query_class = classify(finding.query);
    const Query shrunk = shrunk_query(finding, basic.get());
    EXPECT_EQ(classify(shrunk), finding.query_class) << finding.provenance;
    if (shrunk != simplest) ++changed;
  }
  EXPECT_GE(changed, 1);
}

TEST(Shrink, AQueryOverTheTimeLimitBecomesSimple) {
  const Query query = make_query(find_family("uniform"), 1, 0);
  const MadeUpSubject hangs("hangs", [](const Query& q) {
    return q.x[3] > 0.25 ? Verdict{.fault = Fault::time} : Verdict::rejected(Rejection::untold);
  });
  const Finding finding{Finding::What::fault, "hangs", "uniform", query, "uniform:1:0", 0, "vt time", query};
  Query expected{.kind = query.kind};
  expected.x[3] = expected.x[12 + 3] = 1;
  EXPECT_EQ(shrunk_query(finding, &hangs), expected);
}

TEST(Shrink, AsksASlowSubjectAFewTimesOnly) {
  const Query query = make_query(find_family("uniform"), 1, 0);
  int asked = 0;
  constexpr std::chrono::milliseconds takes(10);
  const MadeUpSubject late("late", [&](const Query&) {
    ++asked;
    std::this_thread::sleep_for(takes);
    return Verdict{.fault = Fault::time};
  });
  Finding finding{Finding::What::fault, "late", "uniform", query, "uniform:1:0", 0, "vt time", query};
  shrunk_query(finding, &late, Stop::never(), {.time = 2 * takes});
  EXPECT_GE(asked, 1);
  EXPECT_LE(asked, 2);
  finding.what = Finding::What::false_negative;
  finding.signature = "vt";
  asked = 0;
  shrunk_query(finding, &late, Stop::never(),
               // Within this time, the shrinker can ask batches of 1, 2 and 4 small queries, and the query of
               // the finding.
               {.time = 12 * takes});
  EXPECT_GE(asked, 1);
  EXPECT_LE(asked, 1 + 2 + 4 + 1);
}

TEST(Shrink, AsksASlowSubjectTheSameAsAFastOneAndNotForEver) {
  constexpr ShrinkLimits few{.work = 4400};
  const auto basic = make_subject("basic");
  const Finding finding = missed_by_basic().front();
  std::vector<Query> fast_asked;
  const auto note_in = [](std::vector<Query>& asked, std::chrono::milliseconds takes) {
    return [&asked, takes](std::span<const Query> queries, std::span<Verdict> /*verdicts*/) {
      std::this_thread::sleep_for(takes);
      asked.insert(asked.end(), queries.begin(), queries.end());
    };
  };
  std::vector<Query> slow_asked;
  const WatchedSubject fast(*basic, note_in(fast_asked, std::chrono::milliseconds(0)));
  const WatchedSubject slow(*basic, note_in(slow_asked, std::chrono::milliseconds(2)));
  const Query shrunk = shrunk_query(finding, &fast, Stop::never(), few);
  EXPECT_EQ(shrunk_query(finding, &slow, Stop::never(), few), shrunk);
  EXPECT_EQ(slow_asked, fast_asked);
  EXPECT_NE(shrunk, finding.query);
  // The limit ended the search before the search found the simplest query.
  EXPECT_NE(shrunk, shrunk_query(finding, basic.get()));
  EXPECT_LE(fast_asked.size(), few.work);
  EXPECT_GE(fast_asked.size(), few.work / 2 / (1 + ShrinkLimits::of_call));
}

TEST(Shrink, EndsASearchAtAHangAndAsksOneByOneFromThenOn) {
  const auto basic = make_subject("basic");
  // For each call of the subject: the number of queries in the call, and whether the call took too long.
  std::vector<std::pair<std::size_t, bool>> calls;
  const auto hang_at_zero = [&](std::span<const Query> queries, std::span<Verdict> verdicts) {
    bool is_slow = false;
    for (std::size_t i = 0; i < queries.size(); ++i)
      if (std::count(queries[i].x.begin(), queries[i].x.end(), 0.0) > 0) {
        verdicts[i] = {.fault = Fault::time};
        is_slow = true;
      }
    calls.emplace_back(queries.size(), is_slow);
  };
  const WatchedSubject hanging(*basic, hang_at_zero);
  const Subject* const pointer = &hanging;
  const FindingShrinker shrinker(std::span(&pointer, 1), Stop::never(), limits_in_campaign);
  std::size_t searches = 0;
  for (Finding finding : missed_by_basic()) {
    shrinker.shrink(finding);
    EXPECT_TRUE(finding.is_shrunk);
    // For each finding, the shrinker makes one search in all classes, one search in the finding's own class,
    // and one search in the list of small queries of each kind.
    searches += 2 + kinds_of_meshes.size();
  }
  const auto is_slow = [](const auto& call) { return call.second; };
  const auto first = std::find_if(calls.begin(), calls.end(), is_slow);
  ASSERT_NE(first, calls.end());
  EXPECT_TRUE(std::all_of(first + 1, calls.end(), [](const auto& call) { return call.first == 1; }));
  EXPECT_LE(std::count_if(calls.begin(), calls.end(), is_slow), searches);
}

TEST(Shrink, AsksOnlyAboutFiniteQueriesAndNotForEver) {
  Query query{.kind = Kind::vertex_triangle};
  for (std::size_t i = 0; i < 24; ++i)
    query.x[i] = std::ldexp(1 + static_cast<double>(i) / 31, i % 2 == 0 ? 1023 - static_cast<int>(i) : -1040);
  long asked = 0;
  shrunk_while(query, [&](const Query& q) {
    EXPECT_TRUE(is_finite(q));
    ++asked;
    return q.x[0] > 0x1p1000 && q.x[1] != 0 && std::abs(q.x[1]) < 0x1p-1000;  // keeps the query difficult
  });
  EXPECT_GT(asked, 100);
  EXPECT_LT(asked, 200000);
}

}  // namespace
}  // namespace nearmiss
