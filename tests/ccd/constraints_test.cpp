// The tolerances must satisfy constraints, which depend on bounds of rounding errors. Tests these bounds.
#include "ccd/wang/bounds/constraints.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "ccd/wang/bounds/solver_errors.hpp"
#include "ccd/wang/bounds/tight_tolerances.hpp"

namespace nearmiss {
namespace {

using Errors = RoundingErrors<double>;

constexpr std::array members{&Errors::area,      &Errors::height_vt, &Errors::height_ee, &Errors::weight_vt,
                             &Errors::weight_ee, &Errors::length2,   &Errors::weight_ve, &Errors::F,
                             &Errors::residual,  &Errors::delta,     &Errors::least_mu,  &Errors::least_psi};

// `expected` has the errors that §4.2 to §4.5 of the paper state, in units of ε. In double, ε^½ is 2^-26.
TEST(RoundingErrors, AreThePapersAsPrinted) {
  const Errors printed = printed_errors(0x1p-52);
  const std::array<double, 12> expected{13, 21, 16, 565, 362, 22, 44, 0, 0, 311, 33492, 725 * 0x1p26};
  for (std::size_t i = 0; i < members.size(); ++i) EXPECT_EQ(printed.*members[i], expected[i] * 0x1p-52) << i;
}

// Let x = k u. Then e^x - 1 = x + x²/2 + x³/6 + ... exceeds (1 + u)^k - 1, by at most x u. The function
// rounding_error() replaces e^x - 1 by x + x²/2 + x³/4 + ...
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
  const Tolerances<double> tol = tight_tolerances(1.0);
  const Errors errors = full_errors(epsilon<double>(), tol.S, tol.rho);
  const auto less_of = [&](const Errors& some) {
    std::vector<double> less;
    for (const auto& each : constraints(tol, tol.eta, tol.eta, some)) less.push_back(each.less - each.more);
    return less;
  };
  const auto before = less_of(errors);
  for (const auto member : members) {
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
