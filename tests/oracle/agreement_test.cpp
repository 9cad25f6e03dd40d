// What the comparison of three answers says of answers that do not fit together.
#include "oracle/agreement.hpp"

#include <gtest/gtest.h>

namespace nearmiss {
namespace {

/// One contact inside, which all see.
Answers one_contact() {
  return {.exact = true,
          .sturm = {.collision = true, .distinct = 1, .with_multiplicity = 1},
          .parity = {.odd = true}};
}

TEST(Answers, OfOneContactAgree) { EXPECT_EQ(one_contact().disagreement(), ""); }

TEST(Answers, ACollisionThatTheFirstDoesNotSee) {
  Answers answers = one_contact();
  answers.exact = false;
  EXPECT_EQ(answers.disagreement(), "exact");
}

TEST(Answers, ACollisionThatOnlyTheFirstSees) {
  EXPECT_EQ((Answers{.exact = true, .sturm = {}, .parity = {}}.disagreement()), "exact");
}

TEST(Answers, ABoundaryThatOnlyOneSees) {
  Answers answers = one_contact();
  answers.sturm.on_boundary = true;
  EXPECT_EQ(answers.disagreement(), "boundary");
  answers = one_contact();
  answers.parity = {.on_boundary = true};
  EXPECT_EQ(answers.disagreement(), "boundary");
}

TEST(Answers, AnEvenNumberOfRootsThatParityCallsOdd) {
  Answers answers = one_contact();
  answers.sturm.with_multiplicity = 2;
  EXPECT_EQ(answers.disagreement(), "parity");
}

TEST(Answers, OnTheBoundaryParityCountsNothing) {
  Answers answers = one_contact();
  answers.sturm.on_boundary = true;
  answers.parity = {.on_boundary = true};
  EXPECT_EQ(answers.disagreement(), "");
}

TEST(Answers, AllThatDoesNotFitIsNamed) {
  EXPECT_EQ((Answers{.exact = true, .sturm = {.on_boundary = true}, .parity = {.odd = true}}.disagreement()),
            "exact boundary parity");
}

}  // namespace
}  // namespace nearmiss
