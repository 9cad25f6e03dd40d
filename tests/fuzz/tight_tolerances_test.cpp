// The smallest tolerances that satisfy the paper's constraints.
#include "ccd/wang/bounds/tight_tolerances.hpp"

#include <CGAL/Interval_nt.h>
#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <nlopt.hpp>
#include <vector>

#include "fuzz/studies/audit.hpp"

namespace nearmiss {
namespace {

namespace mp = boost::multiprecision;
using CgalInterval = CGAL::Interval_nt<>;

template <unsigned bits>
using BinaryFloat = mp::number<mp::cpp_bin_float<bits, mp::digit_base_2>, mp::et_off>;

/// An interval of double that certainly contains x.
template <class T>
CgalInterval enclosure(const T& x) {
  const auto near = static_cast<double>(x);
  return {std::nextafter(near, -1e300), std::nextafter(near, 1e300)};
}

/// Enclosures of the computed tolerances, each divided by the power of B to which it is proportional.
template <class T>
Tolerances<CgalInterval> enclosed(const T& B) {
  const Tolerances<T> tol = tight_tolerances(B);
  const CgalInterval b = enclosure(B);
  Tolerances<CgalInterval> all;
  all.delta = enclosure(tol.delta) / b / b;
  all.D2 = enclosure(tol.D2) / b / b;
  all.rho = enclosure(tol.rho) / b / b;
  all.psi = enclosure(tol.psi) / b / b;
  all.lambda2 = enclosure(tol.lambda2) / b / b;
  all.R = enclosure(tol.R) / b;
  all.S = enclosure(tol.S) / b;
  all.mu = enclosure(tol.mu) / b / b / b;
  all.tau = enclosure(tol.tau) / b / b;
  all.eta = enclosure(tol.eta) / b;
  return all;
}

/// An edge counts as short if it is shorter than a length E. Returns the largest E that the constraints
/// allow: E² = 4 (R² - r²), with R² = S²/8 and r as in `constraints`.
CgalInterval longest_short_edge(const Tolerances<CgalInterval>& tol,
                                const RoundingErrors<CgalInterval>& errors) {
  const CgalInterval r = (tol.mu + errors.residual) / (tol.tau - errors.area);
  return sqrt(tol.S * tol.S / 8 - r * r) * 2 * (1 - 0x1p-40);
}

void expect_constraints(const Tolerances<CgalInterval>& tol, const CgalInterval& eps, int exponent) {
  const auto errors = full_errors(eps, tol.S, tol.rho);
  // It is enough that the constraints hold for one length E. The test takes the lower end of the interval
  // that encloses the largest allowed E.
  const CgalInterval E = longest_short_edge(tol, errors).inf();
  for (const auto& each : constraints(tol, E, E, errors))
    EXPECT_GE(each.more.inf(), each.less.sup()) << each.about << " for 2^" << exponent;
}

template <class T>
void expect_constraints_as_computed() {
  const int exponent = epsilon_exponent<T>;
  ASSERT_EQ(static_cast<double>(epsilon<T>()), std::ldexp(1.0, exponent));
  for (const double B : {1.0, 1.3, 1.9, 0.7})
    expect_constraints(enclosed(T(B)), CgalInterval(std::ldexp(1.0, exponent)), exponent);
}

// Checks each constraint rigorously in interval arithmetic. The check includes the rounding errors of the
// computed tolerances.
TEST(TightTolerances, SatisfyTheConstraintsAsTheyAreComputed) {
  expect_constraints_as_computed<BinaryFloat<11>>();
  expect_constraints_as_computed<BinaryFloat<12>>();
  expect_constraints_as_computed<BinaryFloat<16>>();
  expect_constraints_as_computed<float>();
  expect_constraints_as_computed<BinaryFloat<32>>();
  expect_constraints_as_computed<double>();
  expect_constraints_as_computed<long double>();
  expect_constraints_as_computed<BinaryFloat<105>>();
  expect_constraints_as_computed<BinaryFloat<113>>();
  expect_constraints_as_computed<BinaryFloat<256>>();
}

TEST(TightTolerances, SatisfyTheConstraintsForEveryNumberOfDigits) {
  for (int exponent = -10; exponent >= -255; --exponent) {
    const CgalInterval eps(std::ldexp(1.0, exponent));
    expect_constraints(tolerances_of(solve_tight(exponent), eps, CgalInterval(1)), eps, exponent);
  }
}

/// The constraints as functions of nine variables. To get the variables, divide each of τ, η, S, λ², D²,
/// E_vt, E_ee, ψ and μ by a power of e = ε^¼, and take the logarithm. ρ is fixed.
struct ToleranceProblem {
  double eps;
  double rho;

  static constexpr unsigned variables = 9;

  /// Computes log(less / more) for each constraint more >= less. This logarithm is positive if the constraint
  /// is violated.
  void violations(const double* x, double* missing) const {
    const ToleranceConstants c{.mu = std::exp(x[8]),
                               .tau = std::exp(x[0]),
                               .eta = std::exp(x[1]),
                               .R = 0,  // determined by S
                               .S = std::exp(x[2]),
                               .lambda2 = std::exp(x[3]),
                               .D2 = std::exp(x[4]),
                               .psi = std::exp(x[7]),
                               .rho = rho};
    const auto tol = tolerances_of(c, eps, 1.0);
    const double e = std::sqrt(std::sqrt(eps));
    for (const auto& each :
         constraints(tol, e * std::exp(x[5]), e * std::exp(x[6]), full_errors(eps, tol.S, tol.rho)))
      *missing++ = std::log(each.less / each.more);
  }
};

/// The smallest D² that NLopt finds when it starts at a point that satisfies the constraints, far from the
/// solution of `solve_tight`.
double lowest_D2(int exponent) {
  const ToleranceConstants c = solve_tight(exponent);
  ToleranceProblem problem{std::ldexp(1.0, exponent), c.rho};
  std::vector<double> x{std::log(c.tau),      std::log(c.eta), std::log(2 * c.S), std::log(0.5 * c.lambda2),
                        std::log(2.5 * c.D2), std::log(c.R),   std::log(c.R),     std::log(1.5 * c.psi),
                        std::log(1.5 * c.mu)};
  double log_D2 = 0;
  for (int again = 0; again < 4; ++again) {
    nlopt::opt optimiser(nlopt::LN_COBYLA, ToleranceProblem::variables);
    optimiser.set_min_objective(
        [](unsigned /*count*/, const double* at, double* /*gradient*/, void* /*data*/) { return at[4]; },
        nullptr);
    optimiser.add_inequality_mconstraint(
        [](unsigned /*count*/, double* missing, unsigned /*variables*/, const double* at,
           double* /*gradient*/,
           void* data) { static_cast<const ToleranceProblem*>(data)->violations(at, missing); },
        &problem, std::vector<double>(constraint_count, 1e-9));
    optimiser.set_initial_step(0.1);
    optimiser.set_xtol_rel(1e-10);
    optimiser.set_maxeval(20000);
    optimiser.optimize(x, log_D2);
  }
  std::vector<double> missing(constraint_count);
  problem.violations(x.data(), missing.data());
  for (const double each : missing) EXPECT_LE(each, 1e-6);
  return std::exp(log_D2);
}

TEST(TightTolerances, AreTheSmallestThatAnotherOptimiserFinds) {
  for (const int exponent : {-10, -16, -23, -36, -52, -104}) {
    const double ratio = lowest_D2(exponent) / solve_tight(exponent).D2;
    const double rounding = 64 * std::ldexp(1.0, exponent);  // the slack in the tolerances that we computed
    EXPECT_LT(ratio, 1 + 1e-5) << exponent;
    EXPECT_GT(ratio, 1 - 1e-5 - rounding) << exponent;
  }
}

TEST(ToleranceTable, HasTheseBounds) {
  for (const ToleranceRow& row : tolerance_table()) {
    EXPECT_NEAR(row.paper_bound, 40.96, row.exponent > -20 ? 1 : 0.1);
    if (row.exponent == -23) {
      EXPECT_NEAR(row.tight_bound, 12.13, 0.01);
    }
    if (row.exponent <= -52) {
      EXPECT_NEAR(row.tight_bound, 11.93, 0.01);
    }
  }
}

// As ε grows, the closed forms, which are the paper's formulas for the tolerances, first violate the
// constraint of the cubic solver: μ = 64 ε^¾ must be at least 33492 ε. The solver needs less than 33492 ε, so
// μ is too small only for scalars with fewer than 13 bits.
TEST(ToleranceTable, ClosedFormsAreFailureProofFromThirteenBitsOn) {
  for (const ToleranceRow& row : tolerance_table()) {
    EXPECT_EQ(row.printed_breaks, row.exponent >= -36 ? "solver" : "") << row.exponent;
    EXPECT_EQ(row.paper_breaks, row.exponent >= -11 ? "solver" : "") << row.exponent;
  }
}

}  // namespace
}  // namespace nearmiss
