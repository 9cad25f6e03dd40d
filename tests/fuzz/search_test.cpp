// Tests the directed search on known defects.
#include "fuzz/search/search.hpp"

#include <gtest/gtest.h>

#include "ccd/query/error.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"
#include "tests/bit_hash.hpp"
#include "tests/fuzz/made_up_subjects.hpp"

namespace nearmiss {
namespace {

Query search(const Family& family, std::uint64_t index) { return make_query(family, 1, index); }

/// Whether one of the first queries of the search for misses is a collision that the subject misses.
bool finds_miss(const std::string& name, std::uint64_t queries) {
  const auto subject = make_any_subject(name);
  const Family family = search_for(SearchFor::misses, *subject);
  for (std::uint64_t i = 0; i < queries; ++i)
    if (const Query query = search(family, i); !subject->decide(query).hit && collides(query)) return true;
  return false;
}

TEST(MissSearch, FindsDefects) {
  EXPECT_TRUE(finds_miss("defect:vv", 20));
  EXPECT_TRUE(finds_miss("defect:D2*0.1", 20));
  EXPECT_TRUE(finds_miss("defect:ve-zero", 20));
  EXPECT_TRUE(finds_miss("basic", 20));  // although basic has no needed_tolerance()
}

TEST(MissSearch, ShowsCollisionsThatNeedMostOfTheTolerance) {
  const auto wang = make_subject("wang");
  double most = 0;
  for (std::uint64_t i = 0; i < 20; ++i) {
    const Query query = search(search_for(SearchFor::misses, *wang), i);
    EXPECT_TRUE(collides(query));
    EXPECT_TRUE(wang->decide(query).hit);
    most = std::max(most, wang->needed_tolerance(query));
  }
  EXPECT_GT(most, 0.2);
}

TEST(Searches, GiveFiniteQueriesWithTheLargestSeparation) {
  const auto advance = make_subject("advance");
  for (const Family& family : searches(*advance, Stop::never(), "1.7976931348623157e308"))
    EXPECT_TRUE(is_finite(search(family, 0))) << family.name;
}

/// A search continues from its best point, so a difference of one bit in a computed number could lead to
/// other queries.
TEST(Searches, GiveTheSameQueriesWithEveryCompiler) {
  testing::BitHash hash;
  for (const char* name : {"wang", "basic", "wang-tight:p24", "defect:vv"}) {
    const auto subject = make_any_subject(name);
    for (const auto& family : {search_for(SearchFor::misses, *subject), search_for(SearchFor::far, *subject)})
      hash.add_all(search(family, 0).x);
  }
  EXPECT_EQ(hash.value(), 0x95311bd1d2b1733a) << std::hex << hash.value();
}

TEST(MissSearch, PassesTheErrorsOfASubjectOn) {
  int asked = 0;
  const auto fail_at_last = [&](const Query&) {
    if (++asked == 100) throw Error("that is all");
    return Verdict{.hit = true, .stage = Stage::unspecified};
  };
  const testing::MadeUpSubject subject("failing", fail_at_last, {.bound = 1});
  EXPECT_THROW(search(search_for(SearchFor::misses, subject), 0), Error);
}

/// Expects that one of the first searches finds a false positive whose distance is more than `wanted` times
/// the subject's claimed bound, and that no search refutes the bound.
void expect_far(const Subject& subject, double wanted, std::uint64_t searches) {
  double ratio = 0;
  for (std::uint64_t i = 0; i < searches && ratio <= wanted; ++i) {
    const Query query = search(search_for(SearchFor::far, subject), i);
    if (!subject.decide(query).hit || collides(query)) continue;
    EXPECT_FALSE(distance_exceeds(query, subject.distance_bound(query)));
    ratio = std::max(ratio, minimum_distance(query).lo / subject.distance_bound(query));
  }
  EXPECT_GT(ratio, wanted);
}

// In float, the claimed bound is large: 0.76 times the pair's size B. If the primitives of a false positive
// are nearly this far apart, many of the planes that culling tests nearly separate them. In a fine scalar,
// the bound is tiny, and the search must make primitives as small as the bound.
TEST(FarSearch, ComesNearTheBoundPastPlaneCullingAndInFineScalars) {
  expect_far(*make_any_subject("wang:float"), 0.8, 40);
  expect_far(*make_any_subject("wang-tight:p112"), 0.9, 10);
}

TEST(FarSearch, RefutesBoundsThatDoNotHold) {
  const auto subject = make_any_subject("defect:lambda2*0");
  bool refuted = false;
  for (std::uint64_t i = 0; i < 40 && !refuted; ++i) {
    const Query query = search(search_for(SearchFor::far, *subject), i);
    refuted = subject->decide(query).hit && distance_exceeds(query, subject->distance_bound(query));
  }
  EXPECT_TRUE(refuted);
}

}  // namespace
}  // namespace nearmiss
