// Checks the error bounds of operations on double words, and the error bound of a cross product.
// tests/proofs/ proves all other error bounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/gmp.hpp>
#include <cmath>

#include "oracle/filter/step_part.hpp"
#include "tests/oracle/hard_queries.hpp"

namespace nearmiss {
namespace {

using certified::DoubleWord;
using certified::Motion;
using certified::roundoff;
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
  for (std::size_t i = 0; i < 50000; ++i) {
    Hard hard(1, i);
    const DoubleWord a = number(hard);
    DoubleWord b = number(hard);
    if (i % 3 == 0) b = DoubleWord(-a.hi * (1 + hard.integer(-3, 3) * 0x1p-52), b.lo * 0x1p-60);
    b = certified::two_sum(b.hi, b.lo);
    worst_sum = std::max(worst_sum, relative_error(a + b, exactly(a) + exactly(b)));
    worst_product = std::max(worst_product, relative_error(a * b, exactly(a) * exactly(b)));
  }
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

}  // namespace
}  // namespace nearmiss
