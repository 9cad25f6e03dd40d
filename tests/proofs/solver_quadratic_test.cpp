// Tests that the times that the quadratic solver computes are, up to a factor near 1, exact roots of the
// given polynomial with another constant c' in place of c.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <vector>

#include "ccd/wang/quadratic.hpp"
#include "tests/proofs/climb.hpp"
#include "tests/proofs/solver_orders.hpp"

namespace nearmiss::proofs {
namespace {

using WideReal = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<300, boost::multiprecision::digit_base_2>,
    boost::multiprecision::et_off>;

/// The coefficients of a t² + b t + c, numbers in the thread's precision.
using QuadraticCoefficients = std::array<double, 3>;

/// The constant c' that results from c by the rounding of b² and 4ac. WideReal is exact for all products of
/// doubles here.
WideReal constant_of_roots(const QuadraticCoefficients& p) {
  const auto [a, b, c] = p;
  const MpfrFloat square = MpfrFloat(b) * MpfrFloat(b);
  const MpfrFloat product = 4 * MpfrFloat(a) * MpfrFloat(c);
  const WideReal b2 = WideReal(b) * b;
  const WideReal of_product =
      c == 0 ? WideReal(1) : WideReal(static_cast<double>(product)) / (4 * WideReal(a) * c);
  const WideReal of_square = b == 0 ? WideReal(1) : b2 / static_cast<double>(square);
  return c * of_product * of_square;
}

/// The errors of the solver, divided by the bounds in the comment on `solve_quadratic`: the relative
/// difference of c' from c, and the largest relative difference of a root of a t² + b t + c' in [0, 1] from
/// the nearest returned time. A value above 1 refutes a bound.
struct Distances {
  double constant = 0;
  double factor = 0;
};

Distances distances(const QuadraticCoefficients& p, int bits) {
  const QuadraticErrors<double> errors(roundoff(bits), false);
  const auto [a, b, c] = p;
  Distances all;
  if (a == 0) return all;  // the root of a linear equation has only one rounding
  const WideReal changed = constant_of_roots(p);
  if (c != 0) all.constant = std::abs(static_cast<double>(changed / c - 1)) / errors.constant;
  const WideReal disc = WideReal(b) * b - 4 * WideReal(a) * changed;
  if (disc < 0) return all;
  CandidateTimes<MpfrFloat, 2> times;
  solve_quadratic(times, MpfrFloat(a), MpfrFloat(b), MpfrFloat(c));
  for (const int sign : {1, -1}) {
    const WideReal root = (-b + sign * sqrt(disc)) / (2 * WideReal(a));
    if (root < 0 || root > 1) continue;
    const auto apart = [&](const WideReal& time) {
      return static_cast<double>(root == 0 ? WideReal(abs(time)) : WideReal(abs(time / root - 1)));
    };
    double nearest = apart(1);  // t = 1 stands for a root that is computed as larger than 1
    for (const MpfrFloat& t : times) nearest = std::min(nearest, apart(WideReal(static_cast<double>(t))));
    all.factor = std::max(all.factor, nearest / errors.factor);
  }
  return all;
}

/// All positive and negative numbers of this many bits with exponents from `lowest` to `highest`; also 0.
std::vector<double> all_numbers(int bits, int lowest, int highest) {
  std::vector<double> all{0};
  for (int exponent = lowest; exponent <= highest; ++exponent)
    for (int i = 1 << (bits - 1); i < 1 << bits; ++i)
      for (const int sign : {1, -1}) all.push_back(sign * std::ldexp(i, exponent - bits + 1));
  return all;
}

TEST(ProofsSolverQuadratic, HoldsForAllNumbersOfThreeBits) {
  constexpr int bits = 3;
  const MpfrFloat::PrecisionScope precision(bits);
  const auto all = all_numbers(bits, -2, 1);
  Distances worst;
  for (const double a : all) {
    for (const double b : all) {
      for (const double c : all) {
        const Distances one = distances({a, b, c}, bits);
        ASSERT_LE(one.constant, 1) << a << ' ' << b << ' ' << c;
        ASSERT_LE(one.factor, 1) << a << ' ' << b << ' ' << c;
        worst = {std::max(worst.constant, one.constant), std::max(worst.factor, one.factor)};
      }
    }
  }
  RecordProperty("constant", std::to_string(worst.constant));
  RecordProperty("factor", std::to_string(worst.factor));
  EXPECT_GT(worst.constant, 0.3);
  EXPECT_GT(worst.factor, 0.1);
}

/// The largest value of the member `which` of Distances that the search finds.
double highest_distance(int bits, double Distances::*which) {
  const MpfrFloat::PrecisionScope precision(bits);
  const auto rounded = [](QuadraticCoefficients p) {
    for (double& x : p) x = snapped(x);
    return p;
  };
  const auto draw = [&](Random& random) {
    const double a = draw_number(random, 18);
    const double root = random.uniform();
    const double other = random.one_in(2) ? random.uniform(-2, 2) : root;
    return rounded({a, -a * (root + other), a * root * other});
  };
  const auto change = [&](Random& random, QuadraticCoefficients p) {
    double& x = p[static_cast<std::size_t>(random.integer(0, 2))];
    x = changed_number(random, x, 36, bits);
    return rounded(p);
  };
  const double found =
      highest({.rounds = 6, .steps = 1000}, draw, change, [&](const QuadraticCoefficients& p) {
        return distances(p, bits).*which;
      }).value;
  ::testing::Test::RecordProperty("of " + std::to_string(bits) + " bits", std::to_string(found));
  return found;
}

TEST(ProofsSolverQuadratic, HoldsWhereASearchComesNearIt) {
  for (const int bits : {8, 11, 16, 24}) {
    const double constant = highest_distance(bits, &Distances::constant);
    EXPECT_LE(constant, 1) << bits;
    EXPECT_GT(constant, 0.8) << bits;
    const double factor = highest_distance(bits, &Distances::factor);
    EXPECT_LE(factor, 1) << bits;
    EXPECT_GT(factor, 0.4) << bits;
  }
}

}  // namespace
}  // namespace nearmiss::proofs
