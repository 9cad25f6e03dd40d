// The families that choose separations keep their promises exactly.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "fuzz/families/contacts.hpp"
#include "oracle/agreement/answers.hpp"
#include "oracle/agreement/checked.hpp"
#include "oracle/distance.hpp"
#include "oracle/features.hpp"
#include "oracle/oracle.hpp"
#include "tests/fuzz/family_queries.hpp"

namespace nearmiss {
namespace {

using testing::at;
using testing::at_rest;
using testing::count_of_400;
using testing::expect_count;
using testing::expect_more;
using testing::first_queries;
using testing::first_time;
using testing::longest_edge;
using Closest = ApproachFeatures::Closest;

/// Expects that the distance first reaches h at `time`, and falls below h immediately after.
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

class SeparationFamily : public ::testing::TestWithParam<Family> {};
INSTANTIATE_TEST_SUITE_P(All, SeparationFamily,
                         ::testing::ValuesIn(separation_families().begin(), separation_families().end()),
                         testing::name_of_test);

TEST_P(SeparationFamily, FiltersAndExactMethodsAgree) {
  for (const Query& query : first_queries(GetParam().name, 100)) {
    const Decision exact = decide_exactly(query);
    const Decision decision = decide(query);
    EXPECT_EQ(decision.collision, exact.collision);
    EXPECT_EQ(decision.is_tie, exact.is_tie);
    EXPECT_EQ(ask_all(query).disagreement(), "");
  }
}

/// How many of 200 queries of a kind have these closest features when their distance is first at most h.
int count_with(const std::string& family, Kind kind, Closest closest) {
  return count_of_400(family, [&](const Query& query) {
    if (query.kind != kind) return false;
    const auto features = approach_features(query);
    return features && features->closest == closest;
  });
}

TEST(SeparationFamilies, ReachTheSeparationBetweenFeaturesOfEveryDimension) {
  for (const char* family : {"reached-separation", "slow-approach", "changed-features", "tied-separation",
                             "starts-near-separation", "sized-separation"})
    for (const Kind kind : kinds_of_meshes)
      for (const Closest closest : {Closest::vertices, Closest::vertex_and_edge, Closest::interiors})
        EXPECT_GE(count_with(family, kind, closest), 20)
            << family << ' ' << short_name(kind) << ' ' << static_cast<int>(closest);
}

TEST(NearSeparation, TheSeparationIsOneOfTheDoublesNextToTheDistance) {
  for (const Query& query : first_queries("near-separation@-54", 60)) {
    const double distance = minimum_distance(query, 0).hi;
    const double below = std::nextafter(distance, 0);
    EXPECT_TRUE(query.separation == distance || query.separation == below);
    EXPECT_EQ(decide_exactly(query).collision, query.separation == distance);
  }
}

TEST(NearSeparation, TheSeparationDiffersAsTheParameterSays) {
  for (const int x : {-40, -4})
    for (const Query& query : first_queries(at("near-separation", x), 60)) {
      const double off = query.separation / minimum_distance(query, 0).hi - 1;
      EXPECT_NEAR(std::abs(off), std::ldexp(1.0, x), std::ldexp(1.0, x - 8));
      EXPECT_EQ(decide_exactly(query).collision, off > 0);
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

TEST(TiedSeparation, TheDistanceIsReachedAtTheStartInsideAndAtTheEnd) {
  using Time = ContactFeatures::Time;
  for (const Time time : {Time::start, Time::inside, Time::end})
    expect_more("tied-separation", 20, [&](const Query& query) {
      const auto features = approach_features(query);
      return features && features->touches && features->time == time;
    });
}

TEST(TiedSeparation, PrimitivesRestOrSlide) {
  const auto rests = [](const Query& query) { return at_rest(query, 0) == query; };
  expect_more("tied-separation", 10, rests);
  expect_more("tied-separation", 15, [&](const Query& query) {  // queries that slide at the distance h
    const double h = query.separation;
    return !rests(query) && is_tie(at_rest(query, 0), h) && is_tie(at_rest(query, 1), h);
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

TEST(ReachedSeparation, TheTimeHasTheBinaryPlacesOfTheParameter) {
  for (const int x : {1, 32})
    for (const Query& query : first_queries(at("reached-separation", x), 200))
      EXPECT_EQ(std::fmod(std::ldexp(first_time(query), x), 2), 1);
}

TEST(ReachedSeparation, TheDistanceIsAboveHBeforeAndBelowHAfter) {
  for (const Query& query : first_queries("reached-separation", 200))
    expect_above_before_and_below_after(query, first_time(query));
}

TEST(SlowApproach, TheDistanceFallsToHInsideTheStep) {
  for (const int x : {-40, -10})
    for (const Query& query : first_queries(at("slow-approach", x), 200)) {
      const double time = first_time(query);
      EXPECT_EQ(16 * time, std::floor(16 * time));
      expect_above_before_and_below_after(query, time);
    }
}

TEST(SlowApproach, TheDistanceStartsAsNearHAsTheParameterSays) {
  for (const int x : {-40, -10})
    for (const Query& query : first_queries(at("slow-approach", x), 200)) {
      const Query start = at_rest(query, 0);
      const double off = 8 * std::ldexp(extent(query), x);
      EXPECT_TRUE(distance_exceeds(start, query.separation));
      EXPECT_FALSE(distance_exceeds(start, query.separation + off));
    }
}

/// The closest features at a time.
Closest closest_at(const Query& query, double time) {
  const Query now = at_rest(query, time);
  return approach_features(with_separation(now, minimum_distance(now, 0).hi))->closest;
}

// In the remaining queries, the closest feature before was another edge of the triangle, or another of two
// parallel edges, so that the features' dimension stays the same; or a side has no length.
TEST(ChangedFeatures, MostChangeToFeaturesOfAnotherDimensionShortlyBefore) {
  constexpr int x = -24;
  int same_last = 0;
  int changed = 0;
  for (const Query& query : first_queries(at("changed-features", x), 200)) {
    const double time = first_time(query);
    const Closest last = closest_at(query, time - std::ldexp(1.0, x - 10));
    same_last += last == approach_features(query)->closest ? 1 : 0;
    changed += last != closest_at(query, time - std::ldexp(1.0, x + 8)) ? 1 : 0;
  }
  EXPECT_GT(same_last, 190);
  EXPECT_GT(changed, 160);
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

TEST(StartsNearSeparation, WhatStartsBelowHappensAtOnce) {
  expect_more("starts-near-separation", 100, [](const Query& query) {
    if (!decide_exactly(at_rest(query, 0)).collision) return false;
    EXPECT_EQ(first_time(query), 0);
    return true;
  });
}

TEST(StartsNearSeparation, WhatStartsAtHEitherPartsOrComesNearer) {
  int parts = 0;
  int comes_nearer = 0;
  for (const Query& query : first_queries("starts-near-separation", 400)) {
    if (!is_tie(at_rest(query, 0), query.separation)) continue;
    EXPECT_EQ(first_time(query), 0);
    ++(decide_exactly(query).is_tie ? parts : comes_nearer);
  }
  EXPECT_GT(parts, 50);
  EXPECT_GT(comes_nearer, 30);
}

TEST(SizedSeparation, TheParameterIsTheRatioToTheSizeOfThePrimitives) {
  for (const int x : {-15, -3, 3, 12})
    expect_more(at("sized-separation", x), 390, [&](const Query& query) {
      const double ratio = query.separation / longest_edge(query, 0) / power_of_ten(x);
      return 1.0 / 4 < ratio && ratio < 8;
    });
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
