// Shrinks the queries of findings (recorded failures) while a trial goes on. No query of the trial has to
// wait for the shrinking.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <tuple>
#include <vector>

#include "fuzz/stop.hpp"
#include "fuzz/trial/shrunk_finding.hpp"
#include "fuzz/trial/trial.hpp"
#include "reports/statistics/finding.hpp"

namespace nearmiss {

/// During the trial, a separate thread shrinks findings; it uses at most a tenth of all processors' time. At
/// the end of the trial, all processors shrink the remaining findings. Findings of ordinary queries are
/// shrunk first, and the first finding of each signature (signatures.hpp) is shrunk before the second. The
/// order does not affect the shrunk queries. Only one thread at a time may call the functions of this class.
class Shrinking {
 public:
  /// If `enabled` is true, the findings that FirstFindings keeps are shrunk; otherwise, none is. The subjects
  /// and `stop` must outlive this object.
  Shrinking(const Subjects& subjects, int jobs, const Stop& stop, bool enabled);
  Shrinking(const Shrinking&) = delete;
  Shrinking& operator=(const Shrinking&) = delete;
  ~Shrinking();

  /// Queues a finding to be shrunk, and gives it the next number; the first finding has the number 0.
  void add(const Finding& finding) { add(finding, first_.count(finding)); }

  /// Removes from a result all findings except the first ones of each signature and class (FirstFindings).
  /// Gives the remaining findings certificates, and queues them to be shrunk. Adds to the result the findings
  /// that have been shrunk since the last call. If shrinking threw an exception, this function throws it
  /// again.
  void sift(TrialResult& result);

  /// The findings that have been shrunk since the last call. The key is the finding's number. If shrinking
  /// threw an exception, this function throws it again.
  [[nodiscard]] std::map<std::size_t, Finding> take();

  /// The number of findings that are still to be shrunk.
  [[nodiscard]] std::size_t left() const;

  /// Shrinks the remaining findings on all cores; ends early when Stop::grace has passed since the time
  /// limit, or at a request to stop. Meanwhile, calls `report` several times a second.
  void finish(const std::function<void()>& report);

 private:
  using Clock = Stop::Clock;
  /// `nth` is the number of the finding among the findings of the same signature and class.
  void add(const Finding& finding, std::size_t nth);
  /// The order of shrinking: by class, then by number among the findings of the same signature and class,
  /// then by number among all findings.
  using Priority = std::tuple<QueryClass, std::size_t, std::size_t>;
  struct Task {
    std::size_t number;
    Finding finding;
  };

  /// Starts a thread that calls work(); returns false if the system cannot start another thread.
  bool start();
  /// Shrinks the findings that wait to be shrunk. If the trial still has queries to ask, then waits for more
  /// findings.
  void work();
  void shrink(Task& task);
  /// While queries are being asked, waits until the shrinking thread has used no more than a tenth of all
  /// processors' time.
  void rest();

  FindingShrinker shrinker_;
  int jobs_;
  const Stop& stop_;
  bool enabled_;
  FirstFindings first_;
  std::size_t count_ = 0;

  mutable std::mutex mutex_;
  std::condition_variable has_changed_;
  std::map<Priority, Task> waiting_;
  std::size_t under_way_ = 0;
  std::map<std::size_t, Finding> shrunk_;
  std::exception_ptr failure_;
  bool is_hurried_ = false;  // whether all queries have been asked
  int working_ = 0;          // threads in work()
  bool ends_ = false;

  const Clock::time_point start_ = Clock::now();
  Clock::time_point busy_since_ = start_;  // when the shrinking thread's present work began
  Clock::duration busy_{};                 // the time that this thread worked before busy_since_
  std::vector<std::thread> threads_;
};

}  // namespace nearmiss
