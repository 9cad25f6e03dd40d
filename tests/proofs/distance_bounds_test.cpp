// Proves that two margins for rounding suffice. One margin is for heights along diagonals, in the test
// whether planes separate primitives by more than a separation h. The other margin is for the ends of gaps,
// which are parts of the step that no bound covers yet, in the search for the first time at which the
// distance is small.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "oracle/distance/quick_search.hpp"
#include "oracle/filter/planes.hpp"
#include "tests/proofs/gappa_process.hpp"
#include "tests/proofs/script.hpp"

namespace nearmiss::proofs {
namespace {

/// A script whose numbers are in units of |A| + |B|. A and B are rounded sums: A is the lowest height of one
/// primitive, and B is the highest height of the other primitive. `eA` to `e3` are the relative errors of the
/// operations: exact heights are A (1 + eA) and B (1 + eB). The script concludes: if the code finds that the
/// heights differ by more than √2 h, the exact heights differ by more than √2 h, too.
std::string heights(double root_of_two, double height_rounding) {
  constexpr const char* rounded = "in [-1b-53, 1b-53]";
  return fmt::format(
      "D = D0 * (1 + eD);\n"
      "r = {1} * (1 + eM);\n"
      "T = (({0} * h * (1 + e1) + r) * (1 + e2) + s) * (1 + e3);\n"
      "slack = D0 + A * eA - B * eB - 1.41421356238 * h;\n"
      "{{ A in [-1, 1] /\\ B in [-1, 1] /\\ D0 in [-1, 1] /\\ h in [0, 2] /\\ s in [0, 1] /\\ eA {2} /\\ eB "
      "{2} /\\\n"
      "  eD {2} /\\ eM {2} /\\ e1 {2} /\\ e2 {2} /\\ e3 {2} /\\ D - T in [0, 4] -> slack >= 1b-60 }}\n"
      "slack -> (D - T) + (A * eA - B * eB) - D0 * eD + (h * ({0} * (1 + e1) * (1 + e2) * (1 + e3) - "
      "1.41421356238)\n"
      "  + r * (1 + e2) * (1 + e3) + s * (1 + e3));\n",
      dyadic(root_of_two), dyadic(height_rounding), rounded);
}

TEST(ProofsOfPlanes, HeightsAlongDiagonalsDifferByMoreThanRootTwoH) {
  EXPECT_TRUE(is_proven(heights(certified::root_of_two, certified::height_rounding)));
  EXPECT_FALSE(is_proven(heights(certified::root_of_two, certified::height_rounding / 2)));
  EXPECT_FALSE(is_proven(heights(1.4142135, certified::height_rounding)));
}

/// The script for this claim: if a bound of the distance holds from t until t + a, the computed beginning of
/// the following gap is at most t + a. The code rounds t + a, subtracts `rounding`, and rounds again.
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

/// The script for this claim: if a bound of the distance holds from t - a until t, the computed end of the
/// preceding gap is at least t - a. (If t - a is rounded to 1, the computed end is at least 1.)
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
  for (const auto script : {ahead, behind}) {
    EXPECT_TRUE(is_proven(script(certified::time_rounding)));
    EXPECT_FALSE(is_proven(script(certified::time_rounding / 2)));
  }
}

}  // namespace
}  // namespace nearmiss::proofs
