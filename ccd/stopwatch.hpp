// The stopwatch by which all subjects are timed alike, in whatever process they run.
#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <ctime>

namespace nearmiss {

/// So many queries are decided before a batch is timed, to bring the subject's code back into the caches.
inline constexpr std::size_t warm_up_queries = 8;

/// How long some work took, in ns. The wall clock is read in some 20 ns, but runs on while another process has the
/// processor; the CPU clock, of this thread or of all threads of this process, does not, but is right to some 500 ns
/// only. So the shorter of both counts; but the wall clock's if the work waited by itself, for a device or a thread.
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

  /// How often the processor was given up voluntarily.
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

/// How much longer `work` takes than `nothing`, which is the same work but for the subject's part: 0 if it does not.
template <class Work, class Nothing>
std::uint64_t time_beyond(clockid_t clock, const Work& work, const Nothing& nothing) {
  const std::uint64_t overhead = time_of(clock, nothing);
  const std::uint64_t time = time_of(clock, work);
  return time - std::min(overhead, time);
}

/// The same of the shortest of three tries each: what disturbs one try seldom disturbs all.
template <class Work, class Nothing>
std::uint64_t best_time_beyond(clockid_t clock, const Work& work, const Nothing& nothing) {
  const auto best = [&](const auto& what) {
    return std::min({time_of(clock, what), time_of(clock, what), time_of(clock, what)});
  };
  const std::uint64_t overhead = best(nothing);
  const std::uint64_t time = best(work);
  return time - std::min(overhead, time);
}

}  // namespace nearmiss
