// The rounding errors in the constraints of the tolerances.
#include "ccd/constraints.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "ccd/solver_errors.hpp"
#include "ccd/tight_tolerances.hpp"

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

TEST(Constraints, LargerErrorsAreNeverEasierToMeet) {
  using Errors = RoundingErrors<double>;
  const Tolerances<double> tol = tight_tolerances(1.0);
  const Errors errors = full_errors(epsilon<double>(), tol.S, tol.rho);
  const auto less_of = [&](const Errors& some) {
    std::vector<double> less;
    for (const auto& each : constraints(tol, tol.eta, tol.eta, some)) less.push_back(each.less - each.more);
    return less;
  };
  const auto before = less_of(errors);
  for (const auto member : {&Errors::area, &Errors::height_vt, &Errors::height_ee, &Errors::weight_vt,
                            &Errors::weight_ee, &Errors::length2, &Errors::weight_ve, &Errors::F,
                            &Errors::residual, &Errors::delta, &Errors::least_mu, &Errors::least_psi}) {
    Errors larger = errors;
    larger.*member *= 1.5;
    const auto after = less_of(larger);
    double growth = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_GE(after[i], before[i]) << i;
      growth += after[i] - before[i];
    }
    EXPECT_GT(growth, 0);
  }
}

}  // namespace
}  // namespace nearmiss
