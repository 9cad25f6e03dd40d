// Simulations in reports.
#include "reports/sections/simulations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/text/json.hpp"

namespace nearmiss {
namespace {

using ::testing::ContainsRegex;

Statistics two_subjects() {
  Statistics statistics;
  for (std::uint64_t step = 0; step < 3; ++step) {
    statistics.simulated[{"scene:sim:cloths", "wang", step}] = {.queries = 1000,
                                                                .unanswered = 5,
                                                                .collisions = 10,
                                                                .positives = 12,
                                                                .false_positives = 2,
                                                                .rounds = 3,
                                                                .picojoules = 5'000'000};
    statistics.simulated[{"scene:sim:cloths", "basic", step}] = {.queries = 1000,
                                                                 .collisions = 10,
                                                                 .positives = 9,
                                                                 .false_negatives = 1,
                                                                 .rounds = 2,
                                                                 .unresolved = step,
                                                                 .tangled = step == 1 ? 70U : step,
                                                                 .picojoules = 1'000'000'000'000 * (3 - step),
                                                                 .solver_ns = 2'000'000};
  }
  for (const Kind kind : kinds_of_meshes)
    statistics.counts[{"wang", kind, "scene:sim:cloths"}].times.nanoseconds = 2'250'000;
  return statistics;
}

TEST(Simulations, HaveALineForEachSubject) {
  const std::string text = simulation_tables(two_subjects());
  EXPECT_THAT(text, ContainsRegex("scene:sim:cloths +steps +rounds +answered +unanswered"));
  EXPECT_THAT(text,
              ContainsRegex("basic +3 +6 +3,000 +0 +27 +30 +3 +0 +3 +70 +1 +2 +3 J +1 J +2 ms +0 ms\n"));
  EXPECT_THAT(text, ContainsRegex(
                        "wang +3 +9 +3,000 +15 +36 +30 +0 +6 +0 +0 +- +0 +5e-06 J +5e-06 J +0 ms +1.5 ms\n"));
  EXPECT_EQ(simulation_tables({}), "");
}

TEST(Simulations, HaveAListForEachCounterInJson) {
  const auto json = simulations_json(two_subjects())["scene:sim:cloths"];
  EXPECT_EQ(json["basic"]["step"], (std::vector{0, 1, 2}));
  EXPECT_EQ(json["basic"]["tangled"], (std::vector{0, 70, 2}));
  EXPECT_EQ(json["wang"]["false_positives"], (std::vector{2, 2, 2}));
  EXPECT_EQ(json["wang"].size(), 12);
}

}  // namespace
}  // namespace nearmiss
