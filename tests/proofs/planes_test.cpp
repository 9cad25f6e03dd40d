// The rounding of heights along diagonals, in the test that planes separate primitives by more than h.
#include "oracle/filter/planes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/proofs/gappa_process.hpp"
#include "tests/proofs/script.hpp"

namespace nearmiss::proofs {
namespace {

/// A script whose numbers are in units of |A| + |B|, where A and B are the rounded sums: the lowest height of
/// one primitive and the highest of the other. `eA` to `e3` are the relative errors of the operations: exact
/// heights are A (1 + eA) and B (1 + eB). The conclusion: if the code says that the heights differ by more
/// than √2 h, the exact heights do.
std::string script(double root_of_two, double height_rounding) {
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
  EXPECT_TRUE(is_proven(script(certified::root_of_two, certified::height_rounding)));
}

TEST(ProofsOfPlanes, FailWithSmallerConstants) {
  EXPECT_FALSE(is_proven(script(certified::root_of_two, certified::height_rounding / 2)));
  EXPECT_FALSE(is_proven(script(1.4142135, certified::height_rounding)));
}

}  // namespace
}  // namespace nearmiss::proofs
