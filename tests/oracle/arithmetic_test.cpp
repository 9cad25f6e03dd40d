// The oracle gives the same answers in every rounding mode of its caller, even if the processor treats
// subnormal numbers as zero. After each call, the caller's mode is restored.
#include <gtest/gtest.h>

#include <vector>

#include "ccd/query/arithmetic.hpp"
#include "oracle/agreement/answers.hpp"
#include "oracle/agreement/checked.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"
#include "tests/arithmetic_modes.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using testing::falling_edge;
using testing::falling_vertex;
using testing::HostileArithmetic;

/// Queries whose answer depends on the last bit of a number, with primitives down to the size of the smallest
/// double.
std::vector<Query> close_calls() {
  std::vector<Query> queries;
  for (const double scale : {1.0, 0x1p-1000, 0x1p-1021, 0x1p-1050, 0x1p-1070})
    for (const double z : {0.0, 1.0, -1.0})
      for (const Query& query : {falling_vertex(0.25, 0.5, 8, z), falling_vertex(0, 0.5, 8, z),
                                 falling_vertex(1.25, 0, 8, z), falling_edge(8, z)})
        queries.push_back(testing::scaled(query, scale));
  for (const double tiny : {0x1p-1074, 0x1p-60})
    for (const Query& query :
         {falling_vertex(tiny, 1 - tiny, 1, -1), falling_vertex(0.25, 0.25, 1, tiny), falling_edge(1, tiny)})
      queries.push_back(query);
  return queries;
}

std::vector<double> answers(const std::vector<Query>& queries) {
  std::vector<double> all;
  std::vector<Decision> decisions(queries.size());
  decide(queries, decisions);
  for (const Decision& decision : decisions) all.push_back(decision.collision ? 1 : 0);
  for (const Query& query : queries) {
    all.push_back(collides(query) ? 1 : 0);
    all.push_back(collides_exactly(query) ? 1 : 0);
    auto time = earliest_time(query);
    all.insert(all.end(), {time ? time->enclosure().lo : 2, time ? time->enclosure().hi : 2});
    for (const Enclosure& each : {minimum_distance(query), minimum_distance(query, 1e-9)})
      all.insert(all.end(), {each.lo, each.hi});
    all.insert(all.end(), {closest_ratio(query, 0x1p-20), closest_time(query),
                           distance_exceeds(query, 0x1p-1060) ? 1.0 : 0.0});
    all.push_back(ask_all(query).disagreement().empty() ? 1 : 0);
  }
  return all;
}

class Hostile : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Arithmetic, Hostile,
                         ::testing::Values(FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO));

/// The oracle's answers about contacts at tiny times, some of them subnormal, with and without a separation.
std::vector<double> answers_about_times() {
  std::vector<double> all;
  for (const double z : {0.0, 0x1p-1030, 0x1p-1074, 0x1.8p-60})
    for (const double h : {0.0, 0x1p-1040, 0x1p-60}) {
      const Query query = with_separation(falling_vertex(0.25, 0.25, z, -1), h);
      auto time = earliest_time(query);
      all.push_back(time ? 1 : 0);
      if (!time) continue;
      for (const double each : {0.0, 0x1p-1074, 0x1p-1040, 0x1.fp-1031, 0x1p-1029, 1.0})
        all.insert(all.end(), {time->is_before(each) ? 1.0 : 0.0, time->makes_late(each) ? 1.0 : 0.0});
      all.insert(all.end(), {time->enclosure().lo, time->enclosure().hi});
      all.push_back(time_disagreement(query, decide(query)).empty() ? 1 : 0);
    }
  return all;
}

TEST_P(Hostile, ArithmeticChangesNoAnswerAndStaysAsItWas) {
  const auto queries = close_calls();
  const auto all_answers = [&] {
    auto all = answers(queries);
    const auto about_times = answers_about_times();
    all.insert(all.end(), about_times.begin(), about_times.end());
    return all;
  };
  const auto expected = all_answers();
  for (const bool flushes : {false, true}) {
    const HostileArithmetic hostile(GetParam(), flushes);
    const std::string before = odd_arithmetic();
    const auto found = all_answers();
    EXPECT_EQ(odd_arithmetic(), before);
    make_arithmetic_plain();  // EXPECT_EQ needs plain arithmetic, too
    EXPECT_EQ(found, expected) << before;
  }
}

}  // namespace
}  // namespace nearmiss
