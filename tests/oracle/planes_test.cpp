// Planes that separate primitives by more than h: exact comparisons, at every size.
#include "oracle/filter/planes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/gmp.hpp>
#include <cmath>

#include "fuzz/random.hpp"
#include "oracle/filter/box.hpp"
#include "tests/queries.hpp"

namespace nearmiss::certified {
namespace {

using Rational = boost::multiprecision::mpq_rational;
using testing::falling_vertex;

template <Kind kind = Kind::vertex_triangle>
bool are_farther_apart(const Query& query, double h) {
  return farther_apart_than<kind>(h, query);
}

TEST(PlanesWithSeparation, SeparateAcrossAxesUpToADistanceOfExactlyH) {
  const Query query = falling_vertex(0.25, 0.25, 3, 2);
  EXPECT_FALSE(are_farther_apart(query, 2));
  EXPECT_TRUE(are_farther_apart(query, std::nextafter(2, 0)));
  EXPECT_FALSE(boxes_meet(with_separation(query, std::nextafter(2, 0))));
  EXPECT_TRUE(boxes_meet(with_separation(query, 2)));
}

TEST(PlanesWithSeparation, SeparateAcrossDiagonals) {
  // The vertex slides along the line x + y = 3, which is √2 from the triangle's edge x + y = 1.
  const Query query =
      testing::make_query(Kind::vertex_triangle, {{4, -1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                          {{-1, 4, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  EXPECT_TRUE(are_farther_apart(query, 1.4142));
  EXPECT_FALSE(are_farther_apart(query, 1.41422));
}

TEST(PlanesWithSeparation, OverflowSaysNothing) {
  const double most = std::numeric_limits<double>::max();
  const Query query =
      testing::make_query(Kind::vertex_triangle, {{most, most, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                          {{most, most, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  EXPECT_FALSE(IsFartherAboveDiagonally{1}(HUGE_VAL, 0));
  EXPECT_FALSE(IsFartherAboveDiagonally{1}(most, -most));
  EXPECT_TRUE(are_farther_apart(query, most / 2));  // across an axis
}

/// A number with random bits and a random exponent from `least` to 3.
double random_number(Random& random, int least) {
  return std::ldexp(random.uniform(-1, 1), random.integer(least, 3));
}

// The comparison is right even if h is next to the difference of heights. Rational arithmetic checks every
// claim.
TEST(PlanesWithSeparation, NeverClaimMoreThanTheExactHeights) {
  int claims = 0;
  for (std::size_t i = 0; i < 20000; ++i) {
    Random random(41, 0, i);
    const int least = i % 2 == 0 ? -60 : 2;
    const int size = std::array{0, -1070, -540, 1015}[i / 2 % 4];
    std::array<double, 4> c;
    for (double& each : c) each = std::ldexp(random_number(random, least), size);
    const Rational difference = Rational(c[0]) + Rational(c[1]) - Rational(c[2]) - Rational(c[3]);
    const double above = (c[0] + c[1]) - (c[2] + c[3]);
    for (const double ulps : {-3.0, -1.0, 0.0, 1.0, 0x1p20, 0x1p30}) {
      const double h = above / std::sqrt(2.0) * (1 - ulps * 0x1p-53);
      if (!(h > 0) || !std::isfinite(h) || !IsFartherAboveDiagonally{h}(c[0] + c[1], c[2] + c[3])) continue;
      ++claims;
      EXPECT_GT(difference, 0) << "case " << i;
      EXPECT_GT(Rational(difference * difference), Rational(2 * Rational(h) * Rational(h))) << "case " << i;
    }
  }
  EXPECT_GT(claims, 3000);
}

}  // namespace
}  // namespace nearmiss::certified
