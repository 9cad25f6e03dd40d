// Some modes of the processor make its arithmetic differ from plain double arithmetic. Tests that these modes
// are detected, named and reset.
#include "ccd/query/arithmetic.hpp"

#include <gtest/gtest.h>

#include "ccd/subjects/subject.hpp"
#include "ccd/wang/wang.hpp"
#include "tests/arithmetic_modes.hpp"

namespace nearmiss {
namespace {

using testing::HostileArithmetic;

TEST(Arithmetic, IsPlainAtFirst) {
  EXPECT_TRUE(is_arithmetic_plain());
  EXPECT_EQ(odd_arithmetic(), "");
}

TEST(Arithmetic, WhatIsOddIsNamed) {
  const auto odd = [](int rounding, bool flushes) {
    const HostileArithmetic hostile(rounding, flushes);
    EXPECT_FALSE(is_arithmetic_plain());
    return odd_arithmetic();
  };
  EXPECT_EQ(odd(FE_UPWARD, false), "rounds upward");
  EXPECT_EQ(odd(FE_DOWNWARD, false), "rounds downward");
  EXPECT_EQ(odd(FE_TOWARDZERO, false), "rounds toward zero");
  EXPECT_EQ(odd(FE_TONEAREST, true), "flushes subnormals to zero, takes subnormals for zero");
  EXPECT_EQ(odd(FE_UPWARD, true), "rounds upward, flushes subnormals to zero, takes subnormals for zero");
}

TEST(Arithmetic, TrapsAreOddToo) {
  feenableexcept(FE_DIVBYZERO);
  EXPECT_EQ(odd_arithmetic(), "traps");
  make_arithmetic_plain();
  EXPECT_EQ(odd_arithmetic(), "");
}

TEST(Arithmetic, WhatHappenedIsNotOdd) {
  std::feraiseexcept(FE_ALL_EXCEPT);
  EXPECT_TRUE(is_arithmetic_plain());
  std::feclearexcept(FE_ALL_EXCEPT);
}

TEST(Arithmetic, IsPlainForAScope) {
  const HostileArithmetic hostile(FE_DOWNWARD, true);
  const std::string before = odd_arithmetic();
  {
    const PlainArithmetic guard;
    EXPECT_EQ(odd_arithmetic(), "");
  }
  EXPECT_EQ(odd_arithmetic(), before);
  make_arithmetic_plain();
  EXPECT_EQ(odd_arithmetic(), "");
}

TEST(Arithmetic, OfTheCallerIsNotThatOfOurSubjects) {
  // corpus/cases/scales/vt-subnormal-differences.case
  Query query;
  query.x = {0,          0,           0,         -0x1p-1020,  -0x1p-1020, 0,           0,         0x0.cp-1022,
             -0x1p-1020, 0x1.2p-1006, 0x1p-1006, 0x1p-1006,   0,          0,           0,         0,
             -0x1p-1020, 0,           0,         0x0.cp-1022, -0x1p-1020, 0x1.2p-1006, 0x1p-1006, 0x1p-1006};
  const auto wang = make_subject("wang");
  const HostileArithmetic hostile(FE_TONEAREST, true);
  EXPECT_TRUE(wang->decide(query).hit);
  Verdict verdict;
  wang->decide(std::span(&query, 1), std::span(&verdict, 1));
  EXPECT_TRUE(verdict.hit);
  // Unlike subjects, this function does not set plain arithmetic, so the caller's arithmetic changes the
  // answer.
  EXPECT_FALSE((::nearmiss::wang<Kind::vertex_triangle, double, WangOptions{}>(query).hit));
}

}  // namespace
}  // namespace nearmiss
