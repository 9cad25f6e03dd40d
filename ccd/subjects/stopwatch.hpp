// Measures the run times of all subjects alike, whichever process they run in.
#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <ctime>

namespace nearmiss {

/// The number of queries that a subject decides before the timing of its batch begins. These queries bring
/// the subject's code back into the caches.
inline constexpr std::size_t warm_up_queries = 8;

/// Measures the time since its construction by two clocks. Reading the wall clock takes only about 20 ns, but
/// this clock also counts the time in which another process has the processor. The CPU clock counts only the
/// time of this thread, or of all threads of this process, but is less precise. So the result is the shorter
/// of the two times. If the work itself waited for a device or a thread, the result is the time by the wall
/// clock.
class Stopwatch {
 public:
  /// CLOCK_THREAD_CPUTIME_ID or CLOCK_PROCESS_CPUTIME_ID
  explicit Stopwatch(clockid_t clock) : is_of_thread_(clock == CLOCK_THREAD_CPUTIME_ID), start_(usage()) {}

  [[nodiscard]] std::uint64_t nanoseconds() const {
    const std::chrono::nanoseconds wall = Wall::now() - wall_start_;
    const auto [cpu, waits] = usage();
    const auto elapsed = static_cast<std::uint64_t>(wall.count());
    const std::uint64_t rounding = is_of_thread_ ? 0 : 2000;
    return waits == start_.waits ? std::min(elapsed, cpu - start_.cpu + rounding) : elapsed;
  }

 private:
  using Wall = std::chrono::steady_clock;

  struct Usage {
    std::uint64_t cpu;  ///< ns of CPU time, accurate to about 500 ns for a thread, and to 2 µs for a process
    long waits;         ///< the number of voluntary context switches
  };

  /// For a process, getrusage() gives the CPU time. CLOCK_PROCESS_CPUTIME_ID is not used: it advances only
  /// with the kernel's ticks while the process has a limit or a timer of CPU time. A plug-in or `ulimit -t`
  /// may set such a limit. For a thread, CLOCK_THREAD_CPUTIME_ID gives the CPU time, because getrusage()
  /// advances only with the kernel's ticks.
  [[nodiscard]] Usage usage() const {
    rusage usage{};
    getrusage(is_of_thread_ ? RUSAGE_THREAD : RUSAGE_SELF, &usage);
    timespec time{};
    if (is_of_thread_)
      clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    else
      time = {usage.ru_utime.tv_sec + usage.ru_stime.tv_sec,
              1000 * (usage.ru_utime.tv_usec + usage.ru_stime.tv_usec)};
    return {
        static_cast<std::uint64_t>(time.tv_sec) * 1'000'000'000 + static_cast<std::uint64_t>(time.tv_nsec),
        usage.ru_nvcsw};
  }

  bool is_of_thread_;
  Usage start_;
  Wall::time_point wall_start_ = Wall::now();
};

template <class Work>
std::uint64_t time_of(clockid_t clock, const Work& work) {
  const Stopwatch watch(clock);
  work();
  return watch.nanoseconds();
}

/// The shortest time of three tries of `work`, since a disturbance seldom affects all three. The CPU clock is
/// too inaccurate for most decisions, and reading it takes longer than a decision. So short work is timed by
/// the wall clock. If the first try takes long, a Stopwatch times three more tries, and the first try does
/// not count.
template <class Work>
std::uint64_t best_time_of(clockid_t clock, const Work& work) {
  constexpr std::uint64_t short_time = 5000;  // ns
  const auto by_wall = [&] {
    const auto start = std::chrono::steady_clock::now();
    work();
    return static_cast<std::uint64_t>((std::chrono::steady_clock::now() - start) /
                                      std::chrono::nanoseconds(1));
  };
  const std::uint64_t first = by_wall();
  if (first < short_time) return std::min({first, by_wall(), by_wall()});
  return std::min({time_of(clock, work), time_of(clock, work), time_of(clock, work)});
}

/// `time` minus `overhead`, but at least 0.
inline std::uint64_t less_overhead(std::uint64_t time, std::uint64_t overhead) {
  return time - std::min(overhead, time);
}

/// The time of `work` minus the time of `nothing`. `nothing` must do the same as `work`, except for what the
/// subject computes.
template <class Work, class Nothing>
std::uint64_t time_beyond(clockid_t clock, const Work& work, const Nothing& nothing) {
  const std::uint64_t overhead = time_of(clock, nothing);
  return less_overhead(time_of(clock, work), overhead);
}

template <class Work, class Nothing>
std::uint64_t best_time_beyond(clockid_t clock, const Work& work, const Nothing& nothing) {
  const std::uint64_t overhead = best_time_of(clock, nothing);
  return less_overhead(best_time_of(clock, work), overhead);
}

}  // namespace nearmiss
