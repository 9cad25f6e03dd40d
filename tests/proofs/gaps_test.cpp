// The rounding of the ends of gaps, in the search for the first time at which the distance is small.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "oracle/distance/quick_search.hpp"
#include "tests/proofs/gappa_process.hpp"
#include "tests/proofs/script.hpp"

namespace nearmiss::proofs {
namespace {

/// The script of the claim that t + a, rounded and less `rounding`, rounded again, is not above t + a, for a time t and a bound
/// that reaches as far as a.
std::string ahead(double rounding) {
  return fmt::format(
      "@double = float<ieee_64, ne>;\n"
      "t = double(t0);\n"
      "a = double(a0);\n"
      "sum = double(t + a);\n"
      "end = double(sum - {0});\n"
      "{{ t in [0, 1] /\\ t + a in [0, 1] -> end - (t + a) <= 0 }}\n"
      "end - (t + a) -> (end - (sum - {0})) + (sum - (t + a)) - {0};\n",
      dyadic(rounding));
}

/// The same for t - a, which is not above its rounded end. (If t - a is rounded to 1, the end is at least 1.)
std::string behind(double rounding) {
  return fmt::format(
      "@double = float<ieee_64, ne>;\n"
      "t = double(t0);\n"
      "a = double(a0);\n"
      "difference = double(t - a);\n"
      "end = double(difference + {0});\n"
      "{{ t in [0, 1] /\\ t - a in [0, 1] /\\ difference in [0, 0.99999999999999988897] -> end - (t - a) >= "
      "0 }}\n"
      "end - (t - a) -> (end - (difference + {0})) + (difference - (t - a)) + {0};\n",
      dyadic(rounding));
}

TEST(ProofsOfGaps, TheirEndsAreNotRoundedOutward) {
  EXPECT_TRUE(is_proven(ahead(certified::time_rounding)));
  EXPECT_TRUE(is_proven(behind(certified::time_rounding)));
}

TEST(ProofsOfGaps, FailWithASmallerConstant) {
  EXPECT_FALSE(is_proven(ahead(certified::time_rounding / 2)));
  EXPECT_FALSE(is_proven(behind(certified::time_rounding / 2)));
}

}  // namespace
}  // namespace nearmiss::proofs
