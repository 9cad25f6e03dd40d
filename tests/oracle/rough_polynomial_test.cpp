// The signs of polynomials that are computed with doubles and error bounds never contradict exact arithmetic.
#include "oracle/certificates/rough.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "fuzz/random.hpp"
#include "oracle/certificates/positive.hpp"

namespace nearmiss::certificates {
namespace {

TEST(RoughPolynomial, NeverContradictsTheExactOne) {
  constexpr std::uint64_t cases = 20000;
  int positive = 0;
  int unknown = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    Random random(3, 0, i);
    const double root = random.uniform();
    exact::Polynomial p({Number(1)});
    RoughPolynomial rough{1.0};
    for (int degree = random.integer(1, 8); degree > 0; --degree) {
      // On average, two roots in three are next to the double `root`, and so nearly coincide.
      const double to = random.one_in(3) ? random.uniform() : std::nextafter(root, random.integer(0, 2));
      const double scale = std::ldexp(random.one_in(2) ? 1 : -1, random.integer(-40, 40));
      p = p * exact::Polynomial({Number(-to) * Number(scale), Number(scale)});
      rough = rough * RoughPolynomial{-to * scale, scale};
    }
    const double width = std::ldexp(random.uniform(), random.integer(-80, 0));
    const double begin = random.one_in(3) ? 0 : random.one_in(2) ? random.uniform() : root;
    const Interval interval(begin, Number(begin) + Number(width));
    const auto known = rough.is_positive(interval);
    unknown += known ? 0 : 1;
    if (!known) continue;
    positive += *known ? 1 : 0;
    ASSERT_EQ(*known, is_positive(p, interval.lo, interval.hi)) << "case " << i;
    if (*known) {
      ASSERT_GE(rough(interval.begin + interval.width).sign(), 0) << "case " << i;
    }
  }
  EXPECT_GT(positive, 1000);
  EXPECT_GT(unknown, 1000);
  EXPECT_LT(unknown, 10000);
}

}  // namespace
}  // namespace nearmiss::certificates
