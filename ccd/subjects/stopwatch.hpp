// The stopwatch that times all subjects alike, whichever process they run in.
#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <ctime>

namespace nearmiss {

/// Number of queries decided before a batch is timed, to bring the subject's code back into the caches.
inline constexpr std::size_t warm_up_queries = 8;

/// Measures how long some work took, in ns, by two clocks. The wall clock is precise, since reading it takes
/// about 20 ns, but it keeps running while another process has the processor. The CPU clock counts only the
/// time of this thread, or of all threads of this process, but is only accurate to about 500 ns. So the
/// shorter of the two times counts. If the work itself waited for a device or a thread, the time of the wall
/// clock counts.
class Stopwatch {
 public:
  /// CLOCK_THREAD_CPUTIME_ID or CLOCK_PROCESS_CPUTIME_ID
  explicit Stopwatch(clockid_t clock) : clock_(clock), waits_(waits()), cpu_start_(cpu_time()) {}

  [[nodiscard]] std::uint64_t nanoseconds() const {
    const std::chrono::nanoseconds wall = Wall::now() - wall_start_;
    const std::uint64_t cpu = cpu_time() - cpu_start_;
    const auto elapsed = static_cast<std::uint64_t>(wall.count());
    return waits() == waits_ ? std::min(elapsed, cpu) : elapsed;
  }

 private:
  using Wall = std::chrono::steady_clock;

  /// The number of voluntary context switches.
  [[nodiscard]] long waits() const {
    rusage usage{};
    getrusage(clock_ == CLOCK_THREAD_CPUTIME_ID ? RUSAGE_THREAD : RUSAGE_SELF, &usage);
    return usage.ru_nvcsw;
  }

  [[nodiscard]] std::uint64_t cpu_time() const {
    timespec time{};
    clock_gettime(clock_, &time);
    return static_cast<std::uint64_t>(time.tv_sec) * 1'000'000'000 + static_cast<std::uint64_t>(time.tv_nsec);
  }

  clockid_t clock_;
  long waits_;
  std::uint64_t cpu_start_;
  Wall::time_point wall_start_ = Wall::now();
};

template <class Work>
std::uint64_t time_of(clockid_t clock, const Work& work) {
  const Stopwatch watch(clock);
  work();
  return watch.nanoseconds();
}

/// The shortest time of three tries, since a disturbance seldom affects all three. The CPU clock is too
/// inaccurate for most decisions, and reading it takes longer than a decision. So only the wall clock times
/// short work. If it shows that the work is long, both clocks time three more tries.
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

/// A time minus an overhead; 0 if the overhead is longer.
inline std::uint64_t less_overhead(std::uint64_t time, std::uint64_t overhead) {
  return time - std::min(overhead, time);
}

/// The time of `work` minus that of `nothing`, which is the same work without the subject's part.
template <class Work, class Nothing>
std::uint64_t time_beyond(clockid_t clock, const Work& work, const Nothing& nothing) {
  const std::uint64_t overhead = time_of(clock, nothing);
  return less_overhead(time_of(clock, work), overhead);
}

/// The shortest of three times of `work`, minus the shortest of three times of `nothing`.
template <class Work, class Nothing>
std::uint64_t best_time_beyond(clockid_t clock, const Work& work, const Nothing& nothing) {
  const std::uint64_t overhead = best_time_of(clock, nothing);
  return less_overhead(best_time_of(clock, work), overhead);
}

}  // namespace nearmiss
