// Exact arithmetic confirms the bounds of double words and of the parts of the step.
#include "oracle/filter/step_part.hpp"

#include <CGAL/Mpzf.h>
#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/gmp.hpp>
#include <cmath>
#include <iostream>
#include <vector>

#include "tests/oracle/hard_queries.hpp"
#include "tests/random_queries.hpp"

namespace nearmiss {
namespace {

using certified::Bernstein;
using certified::DoubleWord;
using certified::Motion;
using certified::roundoff;
using certified::StepPart;
using testing::Hard;
using Rational = boost::multiprecision::mpq_rational;

Rational exactly(const DoubleWord& x) { return Rational(x.hi) + Rational(x.lo); }

double relative_error(const DoubleWord& computed, const Rational& exact) {
  if (exact == 0) return exactly(computed) == 0 ? 0 : HUGE_VAL;
  const Rational error = (exactly(computed) - exact) / exact;
  return std::abs(error.convert_to<double>());
}

TEST(DoubleWord, OperationsAreWithinTheirBounds) {
  double worst_sum = 0;
  double worst_product = 0;
  const auto number = [](Hard& hard) {
    const double mantissa = hard.number();
    const double high = std::ldexp(mantissa, hard.integer(-40, 40));
    return certified::two_sum(high, high * 0x1p-53 * hard.uniform(-1, 1));
  };
  for (std::size_t i = 0; i < 300000; ++i) {
    Hard hard(1, i);
    const DoubleWord a = number(hard);
    DoubleWord b = number(hard);
    if (i % 3 == 0) b = DoubleWord(-a.hi * (1 + hard.integer(-3, 3) * 0x1p-52), b.lo * 0x1p-60);
    b = certified::two_sum(b.hi, b.lo);
    worst_sum = std::max(worst_sum, relative_error(a + b, exactly(a) + exactly(b)));
    worst_product = std::max(worst_product, relative_error(a * b, exactly(a) * exactly(b)));
  }
  std::cout << "largest error / 2^-103: sum " << worst_sum * 0x1p103 << ", product "
            << worst_product * 0x1p103 << '\n';
  EXPECT_LT(worst_sum, roundoff<DoubleWord>);
  EXPECT_LT(worst_product, roundoff<DoubleWord>);
}

TEST(CrossBound, HoldsForErrorsAsLargeAsTheFactors) {
  Motion<double> p{};
  p.magnitude = {2, 2, 2};
  p.error = {1, 1, 1};
  Motion<double> q = p;
  q.error = {3, 3, 3};
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_GE(certified::cross_bound(p, q, k).l, 2 * ((2 + 1) * (2 + 3) - 2 * 2)) << k;
}

// --- F and the weights ------------------------------------------------------------------------------------

using CGAL::Mpzf;  // exact sums and products of doubles, much quicker than rational numbers
using MpzfVector = std::array<Mpzf, 3>;

Mpzf dyadic(double x) { return x; }
Mpzf dyadic(const DoubleWord& x) { return Mpzf(x.hi) + Mpzf(x.lo); }

/// |x| / y in double, for a positive y.
double ratio(const Mpzf& x, double y) {
  const int exponent = std::ilogb(y);  // in two factors, because 2^-exponent may overflow
  const Mpzf scaled =
      x * Mpzf(std::ldexp(1.0, -exponent / 2)) * Mpzf(std::ldexp(1.0, -exponent - -exponent / 2));
  return std::abs(CGAL::to_double(scaled)) / std::ldexp(y, -exponent);
}

/// The exact x_i - x_j at a time.
MpzfVector exact_difference(const Query& query, int i, int j, double time) {
  const Mpzf t(time);
  MpzfVector v;
  for (int k = 0; k < 3; ++k) {
    const Mpzf start = Mpzf(query.start(i)[k]) - Mpzf(query.start(j)[k]);
    const Mpzf end = Mpzf(query.end(i)[k]) - Mpzf(query.end(j)[k]);
    v[static_cast<std::size_t>(k)] = (Mpzf(1) - t) * start + t * end;
  }
  return v;
}

MpzfVector cross(const MpzfVector& v, const MpzfVector& w) {
  return {v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]};
}

Mpzf dot(const MpzfVector& v, const MpzfVector& w) { return v[0] * w[0] + v[1] * w[1] + v[2] * w[2]; }

/// The value of the polar form with `times_hi` arguments hi and all other arguments lo.
template <std::size_t n>
Mpzf exact_blossom(std::array<Mpzf, n> row, double lo, double hi, std::size_t times_hi) {
  for (std::size_t level = 0; level < n - 1; ++level) {
    const Mpzf t(level < times_hi ? hi : lo);
    for (std::size_t i = 0; i + 1 < n - level; ++i) row[i] = (Mpzf(1) - t) * row[i] + t * row[i + 1];
  }
  return row[0];
}

/// The largest error / bound among the coefficients, the coefficients on [lo, hi] and the value at lo.
/// `exact` has the exact coefficients, multiplied by `factor`.
template <class Real, std::size_t n>
double error_over_bound(const Bernstein<Real, n>& computed, const std::array<Mpzf, n>& exact, int factor,
                        double lo, double hi) {
  double worst = 0;
  const auto compare = [&](const Real& value, const Mpzf& truth) {
    worst = std::max(worst, ratio(Mpzf(factor) * dyadic(value) - truth, factor * computed.error));
  };
  const auto part = computed.on(lo, hi);
  for (std::size_t i = 0; i < n; ++i) {
    compare(computed.b[i], exact[i]);
    compare(part[i], exact_blossom(exact, lo, hi, i));
  }
  if constexpr (std::is_same_v<Real, double>) compare(computed.at(lo), exact_blossom(exact, lo, lo, 0));
  return worst;
}

/// Whether a sign that is claimed on [t - h, t + h] is the sign of the exact values at t and at both ends.
template <class Real, std::size_t n>
bool is_sign_right(const Bernstein<Real, n>& computed, const std::array<Mpzf, n>& exact, double t, double h) {
  const int sign = computed.sign_near(t, h);
  if (sign == 0) return true;
  for (const double at : {std::max(0.0, t - h), t, std::min(1.0, t + h)})
    if (CGAL::sign(exact_blossom(exact, at, at, 0)) != sign) return false;
  return true;
}

/// The largest error / bound at random times; infinite if a sign is wrong.
template <class Real, std::size_t n>
double worst_of_polynomial(Hard& hard, const Bernstein<Real, n>& computed, const std::array<Mpzf, n>& exact,
                           int factor) {
  const double lo = hard.uniform(0, 1);
  const double hi = hard.uniform(lo, 1);
  const double worst = error_over_bound(computed, exact, factor, lo, hi);
  return is_sign_right(computed, exact, lo, std::abs(hard.small(-60, -1))) ? worst : HUGE_VAL;
}

/// F's exact coefficients on a part of the step, multiplied by three.
std::array<Mpzf, 4> three_times_F(const Query& query, double begin, double end) {
  const auto at_ends = [&](int i) {
    return std::array{exact_difference(query, i, 0, begin), exact_difference(query, i, 0, end)};
  };
  const auto a = at_ends(1);
  const auto b = at_ends(2);
  const auto c = at_ends(3);
  const auto F = [&](std::size_t i, std::size_t j, std::size_t k) { return dot(a[i], cross(b[j], c[k])); };
  return {Mpzf(3) * F(0, 0, 0), F(1, 0, 0) + F(0, 1, 0) + F(0, 0, 1), F(1, 1, 0) + F(1, 0, 1) + F(0, 1, 1),
          Mpzf(3) * F(1, 1, 1)};
}

template <class Real>
double worst_of_query(Hard& hard, const Query& query, bool is_part) {
  StepPart<Real> part = certified::whole_step<Real>(coordinates(query));
  if (is_part) {
    const double begin = hard.uniform(0, 1);
    part = certified::part_of(part, begin, std::min(1.0, begin + std::ldexp(1.0, hard.integer(-45, -1))));
  }
  const auto at_ends = [&](int i, int j) {
    return std::array{exact_difference(query, i, j, part.begin), exact_difference(query, i, j, part.end)};
  };
  const auto a = at_ends(1, 0);
  const auto b = at_ends(2, 0);
  const auto c = at_ends(3, 0);
  double worst = worst_of_polynomial(hard, certified::coplanarity(part.a, part.b, part.c),
                                     three_times_F(query, part.begin, part.end), 3);
  const auto k = static_cast<std::size_t>(hard.integer(0, 2));
  const certified::Weights<Real> weights(query.kind, part, k);
  const auto compare = [&](std::size_t which, const auto& v, const auto& w) {
    const std::array<Mpzf, 3> exact{cross(v[0], w[0])[k],
                                    (cross(v[0], w[1])[k] + cross(v[1], w[0])[k]) * Mpzf(0.5),
                                    cross(v[1], w[1])[k]};
    worst = std::max(worst, worst_of_polynomial(hard, weights.w[which], exact, 1));
  };
  compare(0, b, c);
  if (query.kind == Kind::vertex_triangle) {
    compare(1, c, a);
    compare(2, a, b);
  } else {
    compare(1, a, c);
    compare(2, b, a);
    compare(3, at_ends(3, 1), at_ends(2, 1));
  }
  return worst;
}

template <class Real>
void expect_errors_within_bounds(const char* name, bool part, std::size_t count) {
  double worst = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Hard hard(2, i);
    const Query query = hard.query();
    const double ratio = worst_of_query<Real>(hard, query, part);
    ASSERT_LT(ratio, 1) << testing::repeat(i, query);
    worst = std::max(worst, ratio);
  }
  std::cout << name << ": largest error / bound " << worst << '\n';
  EXPECT_GT(worst, 0);
}

TEST(StepPart, ErrorsInDoubleAreWithinTheirBounds) {
  expect_errors_within_bounds<double>("double", false, 20000);
}
TEST(StepPart, ErrorsOfPartsInDoubleAreWithinTheirBounds) {
  expect_errors_within_bounds<double>("double, part of the step", true, 20000);
}
TEST(StepPart, ErrorsInDoubleWordsAreWithinTheirBounds) {
  expect_errors_within_bounds<DoubleWord>("double words", false, 20000);
}
TEST(StepPart, ErrorsOfPartsInDoubleWordsAreWithinTheirBounds) {
  expect_errors_within_bounds<DoubleWord>("double words, part of the step", true, 20000);
}

// The inputs with the largest error of F in tests/proofs/, 5.7 U M. x0 is 0, so that differences are exact.
TEST(StepPart, TheLargestKnownErrorOfFIsAQuarterOfItsBound) {
  const Query query{.kind = Kind::vertex_triangle,
                    .x = {0,
                          0,
                          0,  // x0
                          -0x1.7bd794fc245dbp-1,
                          -0x1.ffffffffff94fp-1,
                          0x1.c40d55b5a9b34p-1,
                          0x1.c056904efbff8p-2,
                          -0x1.f6d692f2533ccp-1,
                          0x1.7a44a2635433ap-3,
                          -0x1.42296ad49db6p-1,
                          -0x1.793d7660dea38p-2,
                          -0x1.33f352849c39cp-1,
                          0,
                          0,
                          0,  // at t = 1
                          -0x1.dfffffffffff4p-3,
                          -0x1.35ffffffffff2p-1,
                          -0x1.ffffffffff2e9p-1,
                          -0x1.fadc6681d9adcp-3,
                          -0x1.967805ebc2a69p-3,
                          -0x1.a68d55df3d874p-3,
                          -0x1.713c3a1814b7cp-2,
                          0,
                          -0x1.39f740c87125ap-1}};
  const auto whole = certified::whole_step<double>(coordinates(query));
  const double ratio =
      error_over_bound(certified::coplanarity(whole.a, whole.b, whole.c), three_times_F(query, 0, 1), 3,
                       0x1.40000000322dp-6, 0x1.cfffffffffffep-1);
  EXPECT_GT(ratio, 0.24);
  EXPECT_LT(ratio, 0.26);
}

}  // namespace
}  // namespace nearmiss
