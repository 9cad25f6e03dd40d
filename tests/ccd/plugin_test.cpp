// Good and bad plug-in subjects.
#include "ccd/plugin.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ccd/arithmetic.hpp"
#include "ccd/error.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::string plugin(const std::string& name) { return NEARMISS_PLUGINS "/" + name + ".so"; }

TEST(Plugin, TheExampleAnswers) {
  const auto subject = make_subject(plugin("example"));
  EXPECT_EQ(subject->name(), "boxes");
  EXPECT_TRUE(subject->decide(testing::falling_vertex(0.25, 0.25, 1, -1)).hit);
  EXPECT_FALSE(subject->decide(testing::falling_vertex(0.25, 0.25, 2, 1)).hit);
  EXPECT_TRUE(subject->decide(testing::falling_edge(1, -1)).hit);
  EXPECT_TRUE(std::isinf(subject->distance_bound(testing::falling_edge(1, -1))));
}

TEST(Plugin, IsToldForWhichKindItGivesABound) {
  const auto subject = make_subject(plugin("bound_of_kind"));
  EXPECT_EQ(subject->distance_bound(testing::falling_vertex(0.25, 0.25, 1, -1)), 0.5);
  EXPECT_EQ(subject->distance_bound(testing::falling_edge(1, -1)), 1.5);
}

TEST(Plugin, ATimeIsPassedOn) {
  const Verdict verdict = make_subject(plugin("always"))->decide(testing::falling_vertex(0, 0, 2, 1));
  EXPECT_TRUE(verdict.hit);
  EXPECT_EQ(verdict.time, 0.5);
  EXPECT_EQ(verdict.stage, Stage::unspecified);
}

TEST(Plugin, LeavesArithmeticPlain) {
  const auto subject = make_subject(plugin("hostile"));
  EXPECT_EQ(odd_arithmetic(), "");
  const Query query = testing::falling_vertex(0, 0, 2, 1);
  for (int i = 0; i < 2; ++i) {
    EXPECT_FALSE(subject->decide(query).hit);
    EXPECT_EQ(odd_arithmetic(), "");
    EXPECT_EQ(subject->distance_bound(query), 0);
    EXPECT_EQ(odd_arithmetic(), "");
  }
}

TEST(Plugin, AnErrorIsAnError) {
  const auto subject = make_subject(plugin("error"));
  const Verdict verdict = subject->decide(Query{});
  EXPECT_EQ(verdict.fault, Fault::error);
  EXPECT_EQ(verdict.fault_code, -7);
  EXPECT_FALSE(verdict.hit);
}

TEST(Plugin, AnotherVersionOfTheInterfaceIsRefused) {
  EXPECT_THAT([] { (void)make_subject(plugin("version_1")); },
              ThrowsMessage<Error>(HasSubstr("found version 1 of the plug-in interface, expected 2")));
}

TEST(Plugin, ASharedObjectWithoutTheFunctionIsRefused) {
  EXPECT_THAT([] { (void)make_subject(plugin("no_function")); },
              ThrowsMessage<Error>(HasSubstr("no function nearmiss_get_subject")));
}

TEST(Plugin, AMissingFileIsRefused) {
  EXPECT_THAT([] { (void)make_subject("./no/such.so"); }, ThrowsMessage<Error>(HasSubstr("cannot load")));
}

TEST(Subjects, AnUnknownNameListsTheKnownOnes) {
  EXPECT_THAT([] { (void)make_subject("wong"); },
              ThrowsMessage<Error>(HasSubstr("basic, basic-plain, wang")));
}

}  // namespace
}  // namespace nearmiss
