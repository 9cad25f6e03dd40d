// Compares the roots of polynomials, and the signs of other polynomials at these roots, with the results of
// CGAL's algebraic kernel.
#include "oracle/exact/root.hpp"

#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/Gmpz.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "fuzz/random.hpp"

namespace nearmiss::exact {
namespace {

Polynomial polynomial(const std::vector<double>& coefficients) {
  return Polynomial(Numbers(coefficients.begin(), coefficients.end()));
}

TEST(Number, DividesWhatItCanWithoutRemainder) {
  const auto number = [](Random& random) {
    Number x = 1;
    for (int i = random.integer(0, 4); i < 5; ++i) {
      const double factor = random.uniform() * 0x1p53;
      x = x * Number(std::ldexp(factor, random.integer(-150, 149))) + Number(random.integer(0, 2));
    }
    return x;
  };
  for (std::uint64_t i = 0; i < 20000; ++i) {
    Random random(2, 0, i);
    const Number a = number(random);
    const Number b = number(random);
    const Number product = a * b;
    if (CGAL::is_zero(b)) continue;
    const Number quotient = product / b;
    ASSERT_EQ(quotient, a) << "case " << i << ", divided by " << b;
    ASSERT_TRUE(quotient.is_canonical());
  }
}

TEST(Polynomial, DividesWithARemainder) {
  const Polynomial p = polynomial({5, -3, 0, 2});
  const Polynomial q = polynomial({1, -4});
  const Division d = divide(p, q);
  EXPECT_LT(d.remainder.degree(), q.degree());
  const Polynomial scaled = d.quotient * q + d.remainder;  // a positive multiple of p
  EXPECT_EQ(sign(scaled.leading()), sign(p.leading()));
  EXPECT_TRUE((Polynomial({p.leading()}) * scaled - Polynomial({scaled.leading()}) * p).is_zero());
}

TEST(Polynomial, WithoutMultipleFactorsHasTheSameRoots) {
  const Polynomial p = polynomial({-1, 2});
  const Polynomial q = polynomial({-1, 3});
  EXPECT_EQ(square_free(p * p * q).degree(), 2);
  EXPECT_EQ(square_free(p * p * q).sign_at(Number(0.5)), 0);
}

TEST(Root, FindsRootsOfEverySort) {
  EXPECT_TRUE(roots_in_step(polynomial({})).empty());
  EXPECT_TRUE(roots_in_step(polynomial({3})).empty());
  EXPECT_TRUE(roots_in_step(polynomial({1, 0, 1})).empty());
  EXPECT_TRUE(roots_in_step(polynomial({-2, 1})).empty());
  auto ends = roots_in_step(polynomial({0, 1, -1}));
  ASSERT_EQ(ends.size(), 2);
  EXPECT_TRUE(ends[0].is(0));
  EXPECT_TRUE(ends[1].is(1));
  auto triple = roots_in_step(polynomial({-1, 3}) * polynomial({-1, 3}) * polynomial({-1, 3}));
  ASSERT_EQ(triple.size(), 1);
  EXPECT_EQ(triple[0].sign_of(polynomial({-1, 3})), 0);
  EXPECT_EQ(triple[0].sign_of(polynomial({-1, 3.0000001})), 1);
}

TEST(Root, PartsCloseRoots) {
  for (const int exponent : {-20, -200, -1000}) {
    const double gap = std::ldexp(1.0, exponent);
    const Number middle = Number(1) + Number(gap);  // three times the root
    const Polynomial p = polynomial({-1, 3}) * Polynomial({-middle, Number(3)}) * polynomial({-1, 1.5});
    auto roots = roots_in_step(p);
    ASSERT_EQ(roots.size(), 3) << exponent;
    EXPECT_EQ(roots[0].sign_of(Polynomial({-middle, Number(3)})), -1);
    EXPECT_EQ(roots[0].sign_of(polynomial({-1, 3})), 0);
    EXPECT_EQ(roots[1].sign_of(polynomial({-1, 3})), 1);
    EXPECT_TRUE(roots[0].is_below(roots[1]));
    EXPECT_FALSE(roots[1].is_below(roots[0]));
    EXPECT_FALSE(roots[1].is_below(roots[1]));
    // The first polynomial has a root next to 0, the second has a root next to 1, and the root of the third
    // is beyond 1.
    ASSERT_EQ(roots_in_step(Polynomial({-Number(gap), Number(3)}) * polynomial({1, -1})).size(), 2);
    ASSERT_EQ(roots_in_step(Polynomial({Number(gap) - Number(1), Number(1)}) * polynomial({-1, 1})).size(),
              2);
    ASSERT_EQ(roots_in_step(Polynomial({-Number(gap) - Number(1), Number(1)})).size(), 0);
  }
}

TEST(Root, PartsClustersOfRoots) {
  for (const unsigned exponent : {40, 400, 1000, 5000}) {
    const Number gap = power_of_half(exponent);
    // The root of this polynomial is a / 3.
    const auto times_3 = [](const Number& a) { return Polynomial({-a, Number(3)}); };
    const Polynomial inside = times_3(1) * times_3(Number(1) + gap) * times_3(Number(1) - Number(3) * gap);
    EXPECT_EQ(roots_in_step(inside * times_3(2)).size(), 4) << exponent;
    // Two of these roots are outside the step.
    const Polynomial at_end = times_3(Number(3) - gap) * times_3(Number(3) - Number(2) * gap) *
                              times_3(Number(3) + gap) * times_3(Number(3) + Number(7) * gap);
    EXPECT_EQ(roots_in_step(at_end * times_3(2)).size(), 3) << exponent;
    // The next polynomials have two complex roots near the real ones.
    const Polynomial complex = times_3(1) * times_3(1) + Polynomial({gap * gap});
    EXPECT_EQ(roots_in_step(inside * complex).size(), 3) << exponent;
    EXPECT_EQ(roots_in_step(inside * inside * complex).size(), 3) << exponent;
    // The next polynomials have roots whose distances from an end of the step are very different.
    for (const Number& end : {Number(0), Number(1)}) {
      const Polynomial from_end({end, Number(1) - Number(2) * end});
      const auto shifted = [&](const Number& a) {
        return Polynomial({-a}) + Polynomial({Number(3)}) * from_end;
      };
      auto roots = roots_in_step(shifted(gap) * shifted(gap * gap) * shifted(Number(7) * gap) * times_3(2));
      ASSERT_EQ(roots.size(), 4) << exponent;
      for (std::size_t i = 1; i < roots.size(); ++i) EXPECT_TRUE(roots[i - 1].is_below(roots[i]));
    }
  }
}

TEST(Root, SharesTheSimplestPolynomialThatIsKnown) {
  const Polynomial common = polynomial({-1, 3});
  auto roots = roots_in_step(common * polynomial({-0.3, 0, 1, 7}));
  auto others = roots_in_step(common * polynomial({0.4, 1, -2, 1, 5}));
  ASSERT_EQ(others.size(), 1);
  const auto same = std::find_if(roots.begin(), roots.end(), [&](Root& root) {
    return !root.is_below(others[0]) && !others[0].is_below(root);
  });
  ASSERT_NE(same, roots.end());
  for (Root* root : {&*same, &others[0]}) {
    EXPECT_EQ(root->sign_of(common), 0);
    EXPECT_EQ(root->sign_of(polynomial({-1, 3.0000001})), 1);
    EXPECT_EQ(root->as_rational(), CGAL::Gmpq(1, 3));
  }
}

// --- parts of an interval ---------------------------------------------------------------------------------

std::vector<int> signs(const OnInterval& on) {
  std::vector<int> signs;
  for (const Number& c : on.coefficients()) signs.push_back(sign(c));
  return signs;
}

TEST(OnInterval, PartsHaveTheSignsOfThePolynomialUnlessRoundingMayHaveChangedThem) {
  int rounded = 0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    Random random(5, 0, i);
    Polynomial p = polynomial({-1, 3});
    for (int degree = random.integer(1, 5); degree > 0; --degree)
      p = p * (Polynomial({Number(random.uniform(-1, 1)), Number(random.uniform(-1, 1))}) +
               Polynomial({power_of_half(static_cast<unsigned>(random.integer(0, 9000)))}));
    Number lo = 0;
    Number hi = 1;
    OnInterval on(p, lo, hi);
    for (int step = 0; step < 6; ++step) {
      // [from, to] is a part of the interval in which the sign changes. The numbers `from` and `to` have many
      // bits.
      Number from = 0;
      Number to = 1;
      for (int k = 0; k < 16; ++k) {
        from = Number(0.0625 * k) + power_of_half(static_cast<unsigned>(random.integer(5, 2000)));
        to = std::min(from + Number(0.125), Number(1));
        if (on.part(from, to).changes() > 0) break;
      }
      on = on.part(from, to);
      on.round();
      const Number width = hi - lo;
      hi = lo + to * width;
      lo = lo + from * width;
      const OnInterval exact(p, lo, hi);
      if (!on.is_certain()) break;
      ASSERT_EQ(signs(on), signs(exact)) << "case " << i << ", step " << step;
      rounded += on.coefficients() == exact.coefficients() ? 0 : 1;
    }
  }
  EXPECT_GT(rounded, 10);

  const Polynomial third = polynomial({-1, 3});
  const Polynomial p = third * third * third * third;
  const Number tiny = power_of_half(5000);
  OnInterval most = OnInterval(p, 0, 1).part(tiny, 1);
  most.round();
  EXPECT_TRUE(most.is_certain());
  const Number below = Number((CGAL::Gmpz(1) << 5000) / CGAL::Gmpz(3)) * tiny - tiny;
  EXPECT_FALSE(most.part(below, below + tiny + tiny).is_certain());  // values near 2^-20000
}

TEST(Root, KnowsWhetherItIsRational) {
  auto roots = roots_in_step(polynomial({-1, 7}) * polynomial({-2, 3}) * polynomial({-0.5, 0, 1}) *
                             polynomial({-1, 4}));
  ASSERT_EQ(roots.size(), 4);
  EXPECT_EQ(roots[0].as_rational(), CGAL::Gmpq(1, 7));
  EXPECT_EQ(roots[1].as_rational(), CGAL::Gmpq(1, 4));
  EXPECT_EQ(roots[2].as_rational(), CGAL::Gmpq(2, 3));
  EXPECT_FALSE(roots[3].as_rational());
}

TEST(Root, ARationalRootIsFoundInAWideInterval) {
  for (int denominator = 3; denominator < 20; denominator += 2)
    for (int numerator = 1; numerator < denominator; ++numerator) {
      auto roots =
          roots_in_step(polynomial({-static_cast<double>(numerator), static_cast<double>(denominator)}));
      ASSERT_EQ(roots.size(), 1U);
      EXPECT_EQ(roots[0].as_rational(), CGAL::Gmpq(numerator, denominator));
    }
}

// If the polynomial is far from linear, the chord gives a bad guess of the root. Then the interval is halved.
TEST(Root, RefiningAtLeastHalvesTheInterval) {
  for (std::uint64_t i = 0; i < 100; ++i) {
    Random random(3, 0, i);
    const double near = std::ldexp(1.0, random.integer(-60, 0));
    for (auto& root : roots_in_step(polynomial({random.uniform(-1, 1) * near, random.uniform(-1, 1) * near,
                                                random.uniform(-1, 1), random.uniform(-1, 1)})))
      for (int k = 0; k < 4; ++k) {
        const Number width = root.hi() - root.lo();
        root.refine();
        ASSERT_LE(Number(2) * (root.hi() - root.lo()), width) << "case " << i << ", step " << k;
      }
  }
}

TEST(Root, IsANumberWhereItHasFewBits) {
  for (const double root : {0.625, 0x1.fp-3, 0x1.23456789abcdp-1, 0x1.23456789abcdfp-30}) {
    auto roots = roots_in_step(polynomial({-root, 1}) * polynomial({0.3, -1, 1}));
    ASSERT_EQ(roots.size(), 1);
    for (int i = 0; i < 2; ++i) roots[0].refine();
    EXPECT_EQ(roots[0].lo(), Number(root));
    EXPECT_EQ(roots[0].hi(), Number(root));
  }
}

TEST(Root, SeesThatAMultipleOfItsPolynomialIsZero) {
  const Polynomial p = polynomial({-0.5, 0, 1});
  auto roots = roots_in_step(p);
  EXPECT_EQ(roots.at(0).sign_of(p * polynomial({-3})), 0);
  EXPECT_FALSE(are_proportional(p, polynomial({-0.5, 0x1p-1000, 1})));
}

// --- beside CGAL ------------------------------------------------------------------------------------------

using AlgebraicKernel = CGAL::Algebraic_kernel_d_1<CGAL::Gmpz>;
using Reference = AlgebraicKernel::Polynomial_1;

/// One polynomial with integer coefficients, both in our type and in CGAL's.
struct Both {
  Polynomial here;
  Reference there;
};

class Integers {
 public:
  explicit Integers(std::uint64_t index) : random_(1, 0, index) {}

  /// A product of factors with small coefficients, some of them repeated. One product in four is multiplied
  /// by a large number and then slightly changed: 1 is added.
  Both polynomial(int degree) {
    Both p{Polynomial({Number(1)}), Reference(1)};
    while (p.here.degree() < degree) {
      const Both factor = this->factor(between(1, degree - p.here.degree()));
      for (int times = between(1, 2); times > 0 && p.here.degree() + factor.here.degree() <= degree; --times)
        p = {p.here * factor.here, p.there * factor.there};
      if (p.here.is_zero()) return p;
    }
    if (between(0, 3) == 0) {
      const int scale = between(1, 1 << 20);
      p = {p.here * Polynomial({Number(scale)}) + Polynomial({Number(1)}), p.there * scale + 1};
    }
    return p;
  }

  int between(int lo, int hi) { return random_.integer(lo, hi); }

 private:
  Both factor(int degree) {
    Numbers here;
    std::vector<CGAL::Gmpz> there;
    for (int i = 0; i <= degree; ++i) {
      const int c = i == degree ? between(1, 9) : between(-9, 9);
      here.emplace_back(c);
      there.emplace_back(c);
    }
    return {Polynomial(std::move(here)), Reference(there.begin(), there.end())};
  }

  Random random_;
};

TEST(Root, AgreesWithTheAlgebraicKernel) {
  const AlgebraicKernel kernel;
  std::size_t found = 0;
  std::size_t zeros = 0;
  for (std::uint64_t i = 0; i < 1500; ++i) {
    Integers integers(i);
    SCOPED_TRACE(i);
    const Both p = integers.polynomial(integers.between(1, 6));
    std::vector<AlgebraicKernel::Algebraic_real_1> reference;
    kernel.solve_1_object()(p.there, false, std::back_inserter(reference));
    std::erase_if(reference, [](const auto& t) {
      return t < AlgebraicKernel::Algebraic_real_1(0) || t > AlgebraicKernel::Algebraic_real_1(1);
    });
    auto roots = roots_in_step(p.here);
    ASSERT_EQ(roots.size(), reference.size()) << p.there;
    found += roots.size();
    const Both q = integers.polynomial(integers.between(1, 3));
    const Both both{q.here * p.here, q.there * p.there};
    for (std::size_t k = 0; k < roots.size(); ++k) {
      const int expected = kernel.sign_at_1_object()(q.there, reference[k]);
      ASSERT_EQ(roots[k].sign_of(q.here), expected) << p.there << " and " << q.there;
      zeros += expected == 0 ? 1 : 0;
      if (k > 0) {
        ASSERT_TRUE(roots[k - 1].is_below(roots[k]));
      }
    }
    // Compares each root of p with each root of p q.
    std::vector<AlgebraicKernel::Algebraic_real_1> others;
    kernel.solve_1_object()(both.there, false, std::back_inserter(others));
    std::erase_if(others, [](const auto& t) {
      return t < AlgebraicKernel::Algebraic_real_1(0) || t > AlgebraicKernel::Algebraic_real_1(1);
    });
    auto other_roots = roots_in_step(both.here);
    ASSERT_EQ(other_roots.size(), others.size());
    for (std::size_t k = 0; k < roots.size(); ++k)
      for (std::size_t l = 0; l < others.size(); ++l)
        ASSERT_EQ(roots[k].is_below(other_roots[l]), reference[k] < others[l]);
  }
  EXPECT_GT(found, 750);
  EXPECT_GT(zeros, 5);
}

}  // namespace
}  // namespace nearmiss::exact
