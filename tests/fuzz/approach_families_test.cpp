// Families that choose separations keep exactly what they promise about distances and times.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "fuzz/families/contacts.hpp"
#include "oracle/agreement/checked.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"
#include "tests/fuzz/family_queries.hpp"

namespace nearmiss {
namespace {

using testing::at;
using testing::at_rest;
using testing::expect_count;
using testing::expect_more;
using testing::first_queries;
using testing::first_time;

/// Expects that the distance first reaches the query's separation h at `time`, and is below h immediately
/// after that time.
void expect_above_before_and_below_after(const Query& query, double time) {
  const Span before{0, time, true};
  if (time > 0) {
    EXPECT_EQ(proved(certify_apart(query, before)), statement_about(query, "apart", before, true));
  }
  const Span until_after{0, std::nextafter(time, 2)};
  EXPECT_EQ(proved(certify_meets(query, until_after, true)),
            statement_about(query, "meets", until_after, true));
}

bool is_tie(const Query& query, double separation) {
  return decide_exactly(with_separation(query, separation)).is_tie;
}

TEST(NearSeparation, TheSeparationIsOneOfTheDoublesNextToTheDistance) {
  for (const Query& query : first_queries("near-separation@-54", 60)) {
    const double distance = minimum_distance(query, 0).hi;
    const double below = std::nextafter(distance, 0);
    EXPECT_TRUE(query.separation == distance || query.separation == below);
    EXPECT_EQ(decide_exactly(query).collision, query.separation == distance);
  }
}

TEST(TiedSeparation, HalfAreTiesAndTheOthersAreTiesBeforeTheSeparationIsMoved) {
  for (const int x : {1, 64})
    expect_count(at("tied-separation", x), 160, 240, [x](const Query& query) {
      const double h = query.separation;
      if (is_tie(query, h)) {
        EXPECT_EQ(proved_answer(query).at_most, true);
        return true;
      }
      EXPECT_NE(is_tie(query, moved_by_ulps(h, x)), is_tie(query, moved_by_ulps(h, -x)));
      return false;
    });
}

TEST(TiedSeparation, SomeTouchAtOneTimeInside) {
  expect_more("tied-separation", 20, [](const Query& query) {
    if (!decide_exactly(query).is_tie) return false;
    const Enclosure first = earliest_time(query)->enclosure();
    const Enclosure last = earliest_time(testing::reversed(query))->enclosure();
    return 0 < first.lo && first.lo < 1 && first.lo == first.hi &&
           last == Enclosure{1 - first.lo, 1 - first.lo};
  });
}

TEST(ReachedSeparation, TheDistanceFallsBelowHAtATimeWithTheBinaryPlacesOfTheParameter) {
  for (const int x : {1, 32})
    for (const Query& query : first_queries(at("reached-separation", x), 100)) {
      const double time = first_time(query);
      EXPECT_EQ(std::fmod(std::ldexp(time, x), 2), 1);
      expect_above_before_and_below_after(query, time);
    }
}

TEST(SlowApproach, TheDistanceFallsToHInsideTheStep) {
  for (const int x : {-40, -10})
    for (const Query& query : first_queries(at("slow-approach", x), 100)) {
      const double time = first_time(query);
      EXPECT_EQ(16 * time, std::floor(16 * time));
      expect_above_before_and_below_after(query, time);
    }
}

TEST(StartsNearSeparation, TheDistanceAtTheStartIsHOrDiffersAsTheParameterSays) {
  for (const int x : {-40, -1}) {
    int ties[3] = {0, 0, 0};
    for (const Query& query : first_queries(at("starts-near-separation", x), 400)) {
      const Query start = at_rest(query, 0);
      const double h = query.separation;
      int found = 0;
      for (const int side : {-1, 0, 1})
        if (is_tie(start, h + side * std::ldexp(h, x))) {
          ++ties[side + 1];
          ++found;
        }
      EXPECT_EQ(found, 1);
    }
    for (const int each : ties) EXPECT_GT(each, 100);
  }
}

TEST(SizedSeparation, HasCollisionsTiesAndMissesOfEverySize) {
  for (const int x : {-15, -3, 3, 12}) {
    int collisions = 0;
    int ties = 0;
    for (const Query& query : first_queries(at("sized-separation", x), 400)) {
      const Decision decision = decide_exactly(query);
      collisions += decision.collision ? 1 : 0;
      ties += decision.is_tie ? 1 : 0;
    }
    EXPECT_GT(collisions, 200) << x;
    EXPECT_GT(ties, 50) << x;
    EXPECT_GT(400 - collisions - ties, 30) << x;
  }
}

}  // namespace
}  // namespace nearmiss
