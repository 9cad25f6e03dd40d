// The families at the ends of what double can hold keep their promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "oracle/oracle.hpp"
#include "tests/fuzz/family_queries.hpp"

namespace nearmiss {
namespace {

using testing::count_of_400;

TEST(Scale, IsThatOfTheLargestCoordinate) {
  for (const int exponent : {-1074, -1000, 0, 1023})
    EXPECT_EQ(count_of_400("scale@" + std::to_string(exponent),
                           [&](const Query& query) {
                             double largest = 0;
                             for (const double c : query.x) largest = std::max(largest, std::abs(c));
                             return std::ldexp(1.0, exponent) <= largest &&
                                    largest / 2 <= std::ldexp(1.0, exponent);
                           }),
              400)
        << exponent;
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
