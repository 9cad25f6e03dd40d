// The rounding errors in the constraints of the tolerances.
#include "ccd/constraints.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "ccd/solver_errors.hpp"

namespace nearmiss {
namespace {

// §4.2 to §4.5 of the paper, in units of ε, with ε^½ = 2^-26.
TEST(RoundingErrors, AreThePapersAsPrinted) {
  const RoundingErrors<double> printed = printed_errors(0x1p-52);
  const std::array in_epsilon{printed.area,      printed.height_vt, printed.height_ee, printed.weight_vt,
                              printed.weight_ee, printed.length2,   printed.weight_ve, printed.F,
                              printed.residual,  printed.delta,     printed.least_mu};
  const std::array<double, 11> expected{13, 21, 16, 565, 362, 22, 44, 0, 0, 311, 33492};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(in_epsilon[i], expected[i] * 0x1p-52) << i;
  EXPECT_EQ(printed.least_psi, 725 * 0x1p-26);
}

// With x = k u, (1 + u)^k - 1 is x + x²/2 + x³/6 ... less than x u, and the bound x + x²/2 + x³/4 + ...
TEST(RoundingErrors, OfTheTheoremAreTightToSecondOrder) {
  for (const double u : {0x1p-10, 0x1p-24, 0x1p-52})
    for (const int k : {1, 8, 40}) {
      const double exact = 6 * std::expm1(k * std::log1p(u));
      const double x = k * u;
      EXPECT_GE(rounding_error(u, 6.0, k), exact) << u << ' ' << k;
      EXPECT_LE(rounding_error(u, 6.0, k), exact * (1 + u + x * x) + 0x1p-80) << u << ' ' << k;
    }
}

}  // namespace
}  // namespace nearmiss
