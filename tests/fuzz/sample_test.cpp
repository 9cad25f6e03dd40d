// Tests which of its queries a trial chooses as samples.
#include "fuzz/trial/sample.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace nearmiss {
namespace {

TEST(Sample, HasTheExpectedPartOfAnyProgression) {
  constexpr std::uint64_t numbers = 100'000;
  for (const std::uint64_t step : {1U, 2U, 256U, 1U << 24})
    for (const std::uint64_t one_in : {1U, 2U, 16U, 256U}) {
      std::uint64_t sampled = 0;
      for (std::uint64_t i = 0; i < numbers; ++i) sampled += is_sampled(7 + step * i, one_in) ? 1 : 0;
      const double expected = static_cast<double>(numbers) / static_cast<double>(one_in);
      EXPECT_NEAR(static_cast<double>(sampled), expected, 5 * std::sqrt(expected)) << step << ' ' << one_in;
    }
}

}  // namespace
}  // namespace nearmiss
