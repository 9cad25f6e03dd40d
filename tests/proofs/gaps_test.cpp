// The rounding of the ends of gaps, in the search for the first time at which the distance is small.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "oracle/distance/quick_search.hpp"
#include "tests/proofs/gappa_process.hpp"
#include "tests/proofs/script.hpp"

namespace nearmiss::proofs {
namespace {

/// The script of the claim that the computed end of a gap after t is not above the exact one, t + a. The code
/// rounds t + a, subtracts `rounding`, and rounds again. t is a time, and a is the time from t on for which a
/// bound of the distance holds.
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

/// The script of the claim that the computed end of a gap before t is not below the exact one, t - a. (If t -
/// a is rounded to 1, the computed end is at least 1.)
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
