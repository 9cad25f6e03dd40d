// The families at the limits of double keep their promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "oracle/oracle.hpp"
#include "tests/fuzz/family_queries.hpp"

namespace nearmiss {
namespace {

using testing::edges;
using testing::expect_all;
using testing::expect_more;
using testing::largest_coordinate;

TEST(Scale, IsThatOfTheLargestCoordinate) {
  for (const int exponent : {-1074, -1000, 0, 1023})
    expect_all(testing::at("scale", exponent), [exponent](const Query& query) {
      const double largest = largest_coordinate(query);
      return std::ldexp(1.0, exponent) <= largest && largest / 2 <= std::ldexp(1.0, exponent);
    });
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
  const auto between = [](double lo, double hi) {
    return [=](const Query& query) {
      const double speed = relative_speed(query);
      return lo <= speed && speed <= hi;
    };
  };
  // In the other queries, the direction of motion is short, or the shapes change.
  expect_more("stiff@8", 300, between(1e6, 1e10));
  expect_more("stiff@-8", 300, between(1e-10, 1e-6));
  expect_all("stiff@-8", between(0, 1e-6));
}

TEST(Aspect, EdgesAreAsUnequalAsTheParameterSays) {
  expect_more("aspect@8", 390, [](const Query& query) {
    const double shortest = testing::shortest_edge(query, 0);
    const double longest = testing::longest_edge(query, 0);
    return 1e6 * shortest <= longest && (shortest == 0 || longest <= 1e10 * shortest);
  });
}

TEST(Offset, PrimitivesAreAsFarFromTheOriginAsTheParameterSays) {
  expect_more("offset@8", 380, [](const Query& query) {
    return 1e6 <= largest_coordinate(query) && largest_coordinate(query) <= 1e9 &&
           relative_speed(query) < 100;
  });
}

TEST(Overflow, DifferencesOfCoordinatesOverflow) {
  expect_more("overflow", 250, [](const Query& query) {
    for (std::size_t i = 0; i < 24; ++i)
      for (std::size_t j = i % 3; j < i; j += 3)
        if (std::isinf(query.x[i] - query.x[j])) return true;
    return false;
  });
}

double sine(const Vector3<double>& a, const Vector3<double>& b) {
  return a.normalized().cross(b.normalized()).norm();
}

TEST(NearParallelEdges, AnEdgeIsNearlyParallelToTheOtherOrToTheMotion) {
  expect_more("near-parallel-edges@-8", 380, [](const Query& query) {
    const auto all = edges(query, 0);
    if (query.kind == Kind::edge_edge) return sine(all[0], all[1]) < 1e-6;
    const Vector3<double> motion = query.end(0) - query.start(0) - query.end(1) + query.start(1);
    return std::any_of(all.begin(), all.end(), [&](const auto& edge) { return sine(edge, motion) < 1e-6; });
  });
}

TEST(Needle, EdgesAreLongAlongOneAxisAlone) {
  expect_more("needle@-8", 360,
              [](const Query& query) {  // an edge may be orthogonal to the axis of the needle
                const auto all = edges(query, 0);
                return std::all_of(all.begin(), all.end(),
                                   [&](const auto& edge) { return sine(edge, all[0]) < 1e-4; });
              });
}

TEST(Rigid, EdgesKeepTheirLengths) {
  expect_all("rigid@0", [](const Query& query) {
    const auto before = edges(query, 0);
    const auto after = edges(query, 1);
    for (std::size_t i = 0; i < before.size(); ++i)
      if (std::abs(before[i].norm() - after[i].norm()) > 1e-12) return false;
    return true;
  });
}

TEST(StaticPair, OnePrimitiveRests) {
  const auto rests = [](const Query& query, int first, int last) {
    for (int i = first; i < last; ++i)
      if (query.start(i) != query.end(i)) return false;
    return true;
  };
  expect_more("static-pair@2", 300, [&](const Query& query) {  // one in four is nudged
    return rests(query, 0, split(query.kind)) != rests(query, split(query.kind), 4);
  });
}

TEST(MixedScale, WhatTouchesGoesOnTouchingWhateverTheExponents) {
  expect_more("mixed-scale@2000", 160, collides_exactly);
}

}  // namespace
}  // namespace nearmiss
