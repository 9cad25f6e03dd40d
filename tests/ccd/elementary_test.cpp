// Elementary functions agree with those of the mathematical library.
#include "ccd/elementary.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace nearmiss {
namespace {

TEST(Elementary, PowersOfTwoAreExactAtWholeNumbers) {
  EXPECT_EQ(log2_of(std::numeric_limits<double>::denorm_min()), -1074);
  for (const int x : {-999, -40, -1, 0, 1, 8, 999}) {
    EXPECT_EQ(exp2_of(x), std::ldexp(1.0, x));
    EXPECT_EQ(log2_of(std::ldexp(1.0, x)), x);
  }
}

TEST(Elementary, PowersOfTwoAreWithinTheirError) {
  for (double x = -999.3; x < 999; x += 0.0173) ASSERT_NEAR(exp2_of(x) / std::exp2(x), 1, 0x1p-50) << x;
}

TEST(Elementary, LogarithmsAreWithinTheirError) {
  for (double x = 0x1p-1060; x < 1e308; x *= 1.0173) {
    const double exact = std::log2(x);
    ASSERT_NEAR(log2_of(x), exact, 0x1p-50 * std::max(1.0, std::abs(exact))) << x;
  }
}

}  // namespace
}  // namespace nearmiss
