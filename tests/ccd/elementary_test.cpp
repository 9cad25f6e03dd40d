// Elementary functions agree with those of the mathematical library.
#include "ccd/wang/elementary.hpp"

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
  for (int i = 0; i < 11'500; ++i) {
    const double x = -999.3 + 0.173 * i;
    ASSERT_NEAR(exp2_of(x) / std::exp2(x), 1, 0x1p-50) << x;
  }
}

TEST(Elementary, LogarithmsAreWithinTheirError) {
  for (int i = 0; i < 8'000; ++i) {
    const double x = std::exp2(-1060 + 0.26 * i);
    const double exact = std::log2(x);
    ASSERT_NEAR(log2_of(x), exact, 0x1p-50 * std::max(1.0, std::abs(exact))) << x;
  }
}

}  // namespace
}  // namespace nearmiss
