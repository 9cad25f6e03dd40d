// Tests the study of tightness, which measures by what factor a tolerance must change until a collision is
// missed.
#include "fuzz/studies/tightness.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "fuzz/subjects/defects.hpp"
#include "oracle/oracle.hpp"
#include "tests/refused.hpp"

namespace nearmiss {
namespace {

using namespace std::chrono_literals;

Extreme measure(const std::string& name, bool among_vertices = false) {
  TightnessPlan plan;
  plan.names = {name};
  plan.among_vertices = among_vertices;
  if (among_vertices)
    plan.families = {as_asked(find_family("v-near-separation"))};
  else
    plan.families = {find_family("planted-ulp"), find_family("near-parallel-edges")};
  plan.time = 1h;
  std::atomic<bool> stop{false};
  Extreme last;
  measure_tightness(
      plan,
      [&](const Extreme& extreme, bool) {
        last = extreme;
        stop = true;  // stops after one wave
      },
      stop);
  return last;
}

TEST(Tightness, GivesAFactorWithWhichItsQueryIsMissed) {
  const Extreme extreme = measure("D2");
  ASSERT_TRUE(extreme.found());
  EXPECT_EQ(extreme.of, Extreme::Of::accepting_tolerance);
  EXPECT_GT(extreme.value, 0);
  EXPECT_LT(extreme.value, 1);
  EXPECT_GT(extreme.queries, 0U);
  EXPECT_TRUE(collides(extreme.query));
  EXPECT_FALSE(try_make_defect(scaled_tolerance("D2", extreme.value))->decide(extreme.query).hit);
  EXPECT_TRUE(try_make_defect(scaled_tolerance("D2", extreme.value * 1.1))->decide(extreme.query).hit);
}

TEST(Tightness, TurnsRoundForTolerancesThatKeepPrimitivesOut) {
  const Extreme extreme = measure("eta");
  ASSERT_TRUE(extreme.found());
  EXPECT_EQ(extreme.of, Extreme::Of::keeping_tolerance);
  EXPECT_GT(extreme.value, 1);
  EXPECT_FALSE(try_make_defect(scaled_tolerance("eta", extreme.value))->decide(extreme.query).hit);
}

TEST(Tightness, TellsHowFarTestsReach) {
  const Extreme extreme = measure("vertex-edge");
  ASSERT_TRUE(extreme.found());
  EXPECT_FALSE(collides(extreme.query));
  EXPECT_GT(extreme.value, 0);
  EXPECT_LT(extreme.value, 1);
}

TEST(Tightness, AmongVerticesIsThatOfTheirTolerances) {
  const Extreme extreme = measure("D2", true);
  ASSERT_TRUE(extreme.found());
  EXPECT_FALSE(is_of_meshes(extreme.query.kind));
  EXPECT_TRUE(collides(extreme.query));
  EXPECT_FALSE(try_make_defect(scaled_tolerance("D2", extreme.value))->decide(extreme.query).hit);
}

TEST(Tightness, KnowsItsNames) {
  EXPECT_EQ(tightness_names().size(), named_tolerances().size() + 3);
  EXPECT_THAT(tightness_names(true),
              ::testing::UnorderedElementsAre("D2", "delta", "S", "psi", "rho", "lambda2", "vertex-edge",
                                              "vertex-vertex"));
  EXPECT_REFUSED(measure("nu"), "'nu'");
  EXPECT_REFUSED(measure("mu", true), "'mu'");
}

}  // namespace
}  // namespace nearmiss
