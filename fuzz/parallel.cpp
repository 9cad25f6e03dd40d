#include "fuzz/parallel.hpp"

#include <sys/mman.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <latch>
#include <new>
#include <system_error>
#include <vector>

namespace nearmiss {

namespace {

/// Tries how many threads the system can start. Starts threads until `jobs` threads exist, including the
/// calling thread, or until the system refuses to start another thread. Then ends the started threads.
/// Returns the number of threads that existed at the same time. If the system refused a thread, returns only
/// half of this number. The other half is a reserve: other processes may start threads before the caller
/// does, and the system still counts a thread for a while after the thread has ended.
int try_threads(int jobs) {
  std::latch all_tried(1);
  std::vector<std::thread> threads;
  threads.reserve(static_cast<std::size_t>(jobs));
  bool are_left = true;
  while (are_left && static_cast<int>(threads.size()) + 1 < jobs) {
    threads.push_back(start_thread([&] { all_tried.wait(); }));
    are_left = threads.back().joinable();
    if (!are_left) threads.pop_back();
  }
  all_tried.count_down();
  for (std::thread& each : threads) each.join();
  const int started = static_cast<int>(threads.size()) + 1;
  return are_left ? started : (started + 1) / 2;
}

/// The number of threads, at most `jobs`, that TBB can use. TBB ends the program if it cannot start a thread.
/// So if `jobs` exceeds the largest number that try_threads() has returned so far, this function calls
/// try_threads() first. TBB keeps the threads that it has started, so it can use a smaller number of threads
/// without another trial.
int usable_threads(int jobs) {
  static std::atomic<int> most = 1;
  if (most < jobs) most = std::max(most.load(), try_threads(jobs));
  return std::min(jobs, most.load());
}

/// Throws std::bad_alloc if too little memory is left to start TBB. Without this check, TBB (2022.1) would
/// not throw an exception if it ran out of memory during its start. It would wait forever for a lock that it
/// holds itself.
void expect_memory_to_start() {
  static std::atomic<bool> has_started = false;
  if (has_started.exchange(true)) return;
  constexpr std::size_t enough = 16'000'000;
  void* const some = mmap(nullptr, enough, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (some == MAP_FAILED) throw std::bad_alloc();
  munmap(some, enough);
}

/// Runs a parallel algorithm on at most `jobs` threads. Without `global_control`, TBB would start at most one
/// thread per core, even if `jobs` is larger.
void on_threads(int jobs, const std::function<void()>& algorithm) {
  expect_memory_to_start();
  jobs = usable_threads(jobs);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(jobs));
  tbb::task_arena(jobs).execute(algorithm);
}

/// Performs the actions of several threads until an action throws an exception. Catches and keeps this
/// exception. If the exception left a TBB pipeline, the items inside the pipeline would leak.
class FirstFailure {
 public:
  template <class Action>
  void watch(const Action& action) {
    if (has_failed_) return;
    try {
      action();
    } catch (...) {
      if (!has_failed_.exchange(true)) failure_ = std::current_exception();
    }
  }
  /// Throws the kept exception, if any. Must be called after all threads have ended.
  void pass_on() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::atomic<bool> has_failed_ = false;
  std::exception_ptr failure_;
};

}  // namespace

std::thread start_thread(std::function<void()> work) {
  try {
    return std::thread(std::move(work));
  } catch (const std::system_error&) {
    return {};
  }
}

void in_parallel(int jobs, std::size_t count, const std::function<void(std::size_t)>& work) {
  on_threads(jobs, [&] { tbb::parallel_for(std::size_t{0}, count, work); });
}

void detail::in_order(int jobs, const std::function<Untyped()>& next, const std::function<void(void*)>& work,
                      const std::function<void(void*)>& take) {
  // The number of items in the pipeline per thread. If each thread has several items, one slow item does not
  // hold up the other threads.
  constexpr std::size_t on_their_way = 16;
  FirstFailure failure;
  const auto make = [&](tbb::flow_control& control) {
    Untyped item;
    failure.watch([&] { item = next(); });
    if (!item) control.stop();
    return item;
  };
  const auto pass = [&](Untyped item) {
    failure.watch([&] { work(item.get()); });
    return item;
  };
  on_threads(jobs, [&] {
    tbb::parallel_pipeline(
        on_their_way * static_cast<std::size_t>(jobs),
        tbb::make_filter<void, Untyped>(tbb::filter_mode::serial_in_order, make) &
            tbb::make_filter<Untyped, Untyped>(tbb::filter_mode::parallel, pass) &
            tbb::make_filter<Untyped, void>(tbb::filter_mode::serial_in_order, [&](const Untyped& item) {
              failure.watch([&] { take(item.get()); });
            }));
  });
  failure.pass_on();
}

}  // namespace nearmiss
