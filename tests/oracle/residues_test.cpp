// Tests what residues modulo a prime show about the roots of two polynomials.
#include "oracle/exact/residues.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "fuzz/random.hpp"

namespace nearmiss::exact {
namespace {

constexpr std::uint64_t seed = 1;

Polynomial random_polynomial(Random& random, int degree) {
  Numbers coefficients;
  for (int i = 0; i < degree; ++i) coefficients.push_back(Number(random.uniform(-1, 1)));
  coefficients.push_back(Number(random.uniform(1, 2)));
  return Polynomial(std::move(coefficients));
}

TEST(Residues, ShowThatRandomPolynomialsAreCoprime) {
  int shown = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    Random random(seed, 0, i);
    const Polynomial p = random_polynomial(random, random.integer(1, 6));
    shown += are_coprime_by_residues(p, random_polynomial(random, random.integer(0, 6))) ? 1 : 0;
  }
  EXPECT_EQ(shown, 200);
}

TEST(Residues, NeverShowItIfThereIsACommonFactor) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    Random random(seed, 1, i);
    const Polynomial common = random_polynomial(random, random.integer(1, 3));
    const Polynomial p = common * random_polynomial(random, random.integer(0, 3));
    EXPECT_FALSE(are_coprime_by_residues(p, common * random_polynomial(random, random.integer(0, 3)))) << i;
  }
}

TEST(Residues, ShowNothingIfThePrimeDividesALeadingCoefficient) {
  const Number prime(2147483647.0);
  const Polynomial factor({Number(1), prime});  // the residue of this polynomial is the constant 1
  EXPECT_FALSE(are_coprime_by_residues(factor, factor * factor));
  EXPECT_FALSE(only_double_factor(factor * factor));
}

TEST(Residues, FindTheFactorOfTheOnlyDoubleRoot) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    Random random(seed, 2, i);
    const Polynomial factor = random_polynomial(random, 1);
    const Polynomial other = random_polynomial(random, 1);
    const Polynomial rest = random_polynomial(random, random.integer(0, 4));
    const Polynomial p = factor * factor * rest;
    const auto found = only_double_factor(p);
    ASSERT_TRUE(found && are_proportional(*found, factor)) << i;
    EXPECT_TRUE(are_proportional(square_free(p), factor * rest)) << i;
    EXPECT_FALSE(only_double_factor(factor * rest)) << i;
    EXPECT_FALSE(only_double_factor(p * factor)) << i;
    EXPECT_FALSE(only_double_factor(p * other * other)) << i;
  }
}

TEST(Residues, RefuseARootThatIsDoubleOnlyModuloThePrime) {
  const Number prime(2147483647.0);
  EXPECT_FALSE(only_double_factor(Polynomial({prime, Number(0), Number(1)})));
  EXPECT_FALSE(only_double_factor(Polynomial({prime - Number(2), Number(5), Number(-4), Number(1)})));
}

}  // namespace
}  // namespace nearmiss::exact
