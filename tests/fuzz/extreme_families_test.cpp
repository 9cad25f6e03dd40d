// The families at the limits of double keep their promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "oracle/oracle.hpp"
#include "tests/fuzz/family_queries.hpp"

namespace nearmiss {
namespace {

using testing::count_of_400;
using testing::edges;
using testing::largest_coordinate;

TEST(Scale, IsThatOfTheLargestCoordinate) {
  for (const int exponent : {-1074, -1000, 0, 1023})
    EXPECT_EQ(count_of_400("scale@" + std::to_string(exponent),
                           [&](const Query& query) {
                             const double largest = largest_coordinate(query);
                             return std::ldexp(1.0, exponent) <= largest &&
                                    largest / 2 <= std::ldexp(1.0, exponent);
                           }),
              400)
        << exponent;
}

/// The fastest motion of a point relative to another point, divided by the longest edge.
double relative_speed(const Query& query) {
  double speed = 0;
  double size = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j)
      speed = std::max(speed, (query.end(i) - query.start(i) - query.end(j) + query.start(j)).norm());
  for (const int time : {0, 1})
    for (const auto& edge : edges(query, time)) size = std::max(size, edge.norm());
  return speed / size;
}

TEST(Stiff, ThePrimitivesMoveAsFastAsTheParameterSays) {
  const auto between = [](const char* family, double lo, double hi) {
    return count_of_400(family, [&](const Query& query) {
      const double speed = relative_speed(query);
      return lo <= speed && speed <= hi;
    });
  };
  EXPECT_GT(between("stiff@8", 1e6, 1e10),
            300);  // in some queries the direction is short, and in others the shapes change
  EXPECT_GT(between("stiff@-8", 1e-10, 1e-6), 300);
  EXPECT_EQ(between("stiff@-8", 0, 1e-6), 400);
}

TEST(Aspect, EdgesAreAsUnequalAsTheParameterSays) {
  const int unequal = count_of_400("aspect@8", [](const Query& query) {
    const auto all = edges(query, 0);
    double shortest = all.front().norm();
    double longest = shortest;
    for (const auto& edge : all) {
      shortest = std::min(shortest, edge.norm());
      longest = std::max(longest, edge.norm());
    }
    return 1e6 * shortest <= longest && (shortest == 0 || longest <= 1e10 * shortest);
  });
  EXPECT_GT(unequal, 390);
}

TEST(Offset, PrimitivesAreAsFarFromTheOriginAsTheParameterSays) {
  const int far = count_of_400("offset@8", [](const Query& query) {
    return 1e6 <= largest_coordinate(query) && largest_coordinate(query) <= 1e9 &&
           relative_speed(query) < 100;
  });
  EXPECT_GT(far, 380);
}

TEST(Overflow, DifferencesOfCoordinatesOverflow) {
  const int overflowing = count_of_400("overflow", [](const Query& query) {
    for (std::size_t i = 0; i < 24; ++i)
      for (std::size_t j = i % 3; j < i; j += 3)
        if (std::isinf(query.x[i] - query.x[j])) return true;
    return false;
  });
  EXPECT_GT(overflowing, 250);
}

double sine(const Vector3<double>& a, const Vector3<double>& b) {
  return a.normalized().cross(b.normalized()).norm();
}

TEST(NearParallelEdges, AnEdgeIsNearlyParallelToTheOtherOrToTheMotion) {
  const int parallel = count_of_400("near-parallel-edges@-8", [](const Query& query) {
    const auto all = edges(query, 0);
    if (query.kind == Kind::edge_edge) return sine(all[0], all[1]) < 1e-6;
    const Vector3<double> motion = query.end(0) - query.start(0) - query.end(1) + query.start(1);
    return std::any_of(all.begin(), all.end(), [&](const auto& edge) { return sine(edge, motion) < 1e-6; });
  });
  EXPECT_GT(parallel, 380);
}

TEST(Needle, EdgesAreLongAlongOneAxisAlone) {
  const int thin = count_of_400("needle@-8", [](const Query& query) {
    const auto all = edges(query, 0);
    return std::all_of(all.begin(), all.end(), [&](const auto& edge) { return sine(edge, all[0]) < 1e-4; });
  });
  EXPECT_GT(thin, 360);  // an edge may be orthogonal to the axis of the needle
}

TEST(Rigid, EdgesKeepTheirLengths) {
  const int kept = count_of_400("rigid@0", [](const Query& query) {
    const auto before = edges(query, 0);
    const auto after = edges(query, 1);
    for (std::size_t i = 0; i < before.size(); ++i)
      if (std::abs(before[i].norm() - after[i].norm()) > 1e-12) return false;
    return true;
  });
  EXPECT_EQ(kept, 400);
}

TEST(StaticPair, OnePrimitiveRests) {
  const auto rests = [](const Query& query, int first, int last) {
    for (int i = first; i < last; ++i)
      if (query.start(i) != query.end(i)) return false;
    return true;
  };
  const int resting = count_of_400("static-pair@2", [&](const Query& query) {
    return rests(query, 0, split(query.kind)) != rests(query, split(query.kind), 4);
  });
  EXPECT_GT(resting, 300);  // one in four is nudged
}

TEST(MixedScale, WhatTouchesGoesOnTouchingWhateverTheExponents) {
  EXPECT_GT(count_of_400("mixed-scale@2000", collides_exactly), 160);
}

}  // namespace
}  // namespace nearmiss
