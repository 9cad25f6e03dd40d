// The stopwatch measures computing time. If the work waits, the stopwatch measures the time that passes.
#include "ccd/subjects/stopwatch.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <stop_token>
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

/// Computes until a clock has advanced by a millisecond.
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

TEST(Stopwatch, CountsShortComputing) {
  constexpr std::uint64_t short_time = 1000;
  const auto compute_shortly = [] {
    const std::uint64_t start = now(CLOCK_MONOTONIC);
    while (now(CLOCK_MONOTONIC) < start + short_time) {
    }
  };
  EXPECT_GE(best_time_of(CLOCK_THREAD_CPUTIME_ID, compute_shortly), short_time);
}

/// Computes for `time` nanoseconds.
void compute_for(std::uint64_t time) {
  const std::uint64_t start = now(CLOCK_MONOTONIC);
  while (now(CLOCK_MONOTONIC) < start + time) {
  }
}

TEST(Stopwatch, CountsComputingWhileTheProcessHasALimitOfCpuTime) {
  rlimit before{};
  getrlimit(RLIMIT_CPU, &before);
  const rlimit limit{std::min<rlim_t>(before.rlim_max, 3600), before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_CPU, &limit), 0);
  for (int i = 0; i < 10; ++i) {
    const std::uint64_t start = now(CLOCK_THREAD_CPUTIME_ID);
    const std::uint64_t counted = time_of(CLOCK_PROCESS_CPUTIME_ID, [] { compute_for(millisecond); });
    EXPECT_GE(counted + millisecond / 10, now(CLOCK_THREAD_CPUTIME_ID) - start);
  }
  setrlimit(RLIMIT_CPU, &before);
}

TEST(Stopwatch, TheBestTimeIsTheShortest) {
  int calls = 0;  // best_time_of() makes one call to see how long the work takes, then times three more
  const auto short_once = [&] { compute_for(++calls == 3 ? millisecond / 10 : 20 * millisecond); };
  EXPECT_LT(best_time_of(CLOCK_THREAD_CPUTIME_ID, short_once), 5 * millisecond);
  EXPECT_EQ(calls, 4);
}

/// Keeps the calling thread on one processor, together with another thread that computes all the time.
class Shared {
 public:
  Shared() {
    sched_getaffinity(0, sizeof before_, &before_);
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(sched_getcpu(), &one);
    sched_setaffinity(0, sizeof one, &one);  // the other thread inherits this affinity
    other_ = std::jthread([](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
      }
    });
  }
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;
  ~Shared() { sched_setaffinity(0, sizeof before_, &before_); }

 private:
  cpu_set_t before_{};
  std::jthread other_;
};

TEST(Stopwatch, DoesNotCountTheTimeOfOthersOnTheProcessor) {
  const Shared shared;
  const std::uint64_t start = now(CLOCK_THREAD_CPUTIME_ID);
  const std::uint64_t counted = time_of(CLOCK_THREAD_CPUTIME_ID, [] {
    for (int i = 0; i < 20; ++i) compute(CLOCK_THREAD_CPUTIME_ID);
  });
  EXPECT_LE(counted, now(CLOCK_THREAD_CPUTIME_ID) - start);
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
