// Tests the functions of oracle/interface on a small stack, and in every mode of the processor's arithmetic.
#include "oracle/interface/nearmiss.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include <array>
#include <cfenv>
#include <limits>
#include <string>

#include "ccd/nearmiss_subject.h"
#include "ccd/query/arithmetic.hpp"
#include "tests/arithmetic_modes.hpp"

namespace nearmiss {
namespace {

using ::testing::Each;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A vertex that falls through a triangle at t = 1/2.
constexpr std::array<double, 24> falling{0.25, 0.25, 1,  0, 0, 0, 1, 0, 0, 0, 1, 0,
                                         0.25, 0.25, -1, 0, 0, 0, 1, 0, 0, 0, 1, 0};

#ifndef _GLIBCXX_ASSERTIONS  // the preset of the sanitizers, which need a larger stack, defines this macro
/// This query needs the deepest stack of all queries that were tried.
TEST(Interface, WorksOnASmallStack) {
  static constexpr std::array deepest{-0x1p+0,
                                      0x1.87e92154ef7acp-665,
                                      -0x1p-1074,
                                      0x1.8p+1,
                                      -0x1p-1074,
                                      -0x1p-1074,
                                      0x0p+0,
                                      0x1.1ccf385ebc8ap+1023,
                                      0x1p-960,
                                      0x1p-1074,
                                      0x1.1ccf385ebc8ap+1023,
                                      0x1.8p+1,
                                      0x1p-1022,
                                      0x1p+0,
                                      0x1p+0,
                                      0x1p-1074,
                                      0x1.4e718d7d7625ap+664,
                                      0x1p-1074,
                                      -0x1.1ccf385ebc8ap+1023,
                                      0x1.1ccf385ebc8ap+1023,
                                      0x1.87e92154ef7acp-665,
                                      0x1.1ccf385ebc8ap+1023,
                                      0x1.fffffffffffffp+1023,
                                      -0x1.1ccf385ebc8ap+1023};
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  ASSERT_EQ(pthread_attr_setstacksize(&attributes, 256 << 10), 0);
  const auto work = [](void* to) -> void* {
    *static_cast<double*>(to) = smallest_distance(Kind::vertex_triangle, deepest, 0).lo;
    return nullptr;
  };
  pthread_t thread{};
  double lo = nan;
  ASSERT_EQ(pthread_create(&thread, &attributes, work, &lo), 0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  EXPECT_GE(lo, 0);
}
#endif

TEST(Interface, AnswersInEveryModeOfTheProcessorAndRestoresIt) {
  for (const int rounding : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO})
    for (const bool flushes : {false, true}) {
      const testing::HostileArithmetic mode(rounding, flushes);
      const std::string before = odd_arithmetic();
      const bool hits = collides(Kind::vertex_triangle, falling) == Answer::collision &&
                        wang(Kind::vertex_triangle, falling) == Answer::collision;
      const double time = earliest_time(Kind::vertex_triangle, falling).hi;
      const double distance = smallest_distance(Kind::vertex_triangle, falling).hi;
      static constexpr double tiny = std::numeric_limits<double>::denorm_min();
      std::int8_t answer = 7;
      const Status status =
          wang(Queries::packed(Kind::vertex_triangle, falling).with_separation(tiny), {&answer, 1});
      EXPECT_EQ(odd_arithmetic(), before);
      EXPECT_TRUE(hits) << before;
      EXPECT_EQ(time, 0.5) << before;
      EXPECT_EQ(distance, 0) << before;
      EXPECT_EQ(status, Status::bad_argument) << before;
    }
}

TEST(Interface, ComparesArgumentsWithoutTraps) {
  feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
  const nearmiss_queries query = nearmiss_packed(NEARMISS_VERTEX_TRIANGLE, 1, falling.data());
  double number = 7;
  std::int8_t answer = 7;
  const std::array found{nearmiss_earliest_time(&query, nan, &number, nullptr),
                         nearmiss_smallest_distance(&query, nan, &number, nullptr),
                         nearmiss_time_of_impact(&query, nan, &answer, &number)};
  const bool hit = collides(Kind::vertex_triangle, falling) == Answer::collision;
  fedisableexcept(FE_ALL_EXCEPT);
  EXPECT_THAT(found, Each(NEARMISS_BAD_ARGUMENT));
  EXPECT_TRUE(hit);
  testing::HostileArithmetic mode(FE_TONEAREST, true);
  EXPECT_EQ(nearmiss_earliest_time(&query, -std::numeric_limits<double>::denorm_min(), &number, nullptr),
            NEARMISS_BAD_ARGUMENT);
}

}  // namespace
}  // namespace nearmiss
