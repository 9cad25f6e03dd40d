// How long work takes: its computing time, or, if it waits, the time that passes.
#include "ccd/stopwatch.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <ctime>
#include <thread>

namespace nearmiss {
namespace {

std::uint64_t now(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<std::uint64_t>(time.tv_sec) * 1'000'000'000 + static_cast<std::uint64_t>(time.tv_nsec);
}

constexpr std::uint64_t millisecond = 1'000'000;
constexpr std::uint64_t clock_error = millisecond / 100;

/// Computes until the clock has gone on by a millisecond.
void compute(clockid_t clock) {
  const std::uint64_t start = now(clock);
  while (now(clock) < start + millisecond) {
  }
}

TEST(Stopwatch, CountsComputing) {
  for (const clockid_t clock : {CLOCK_THREAD_CPUTIME_ID, CLOCK_PROCESS_CPUTIME_ID}) {
    EXPECT_GE(time_of(clock, [&] { compute(clock); }), millisecond - clock_error);
    EXPECT_GE(best_time_of(clock, [&] { compute(clock); }), millisecond - clock_error);
  }
}

TEST(Stopwatch, CountsTheTimeThatPassesWhileTheWorkSleeps) {
  const auto sleep = [] { std::this_thread::sleep_for(std::chrono::milliseconds(2)); };
  EXPECT_GE(time_of(CLOCK_THREAD_CPUTIME_ID, sleep), 2 * millisecond - clock_error);
}

TEST(Stopwatch, AnOverheadThatIsLongerLeavesNothing) {
  EXPECT_EQ(less_overhead(5, 3), 2);
  EXPECT_EQ(less_overhead(3, 5), 0);
}

}  // namespace
}  // namespace nearmiss
