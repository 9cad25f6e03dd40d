#include "fuzz/trial/shrinking.hpp"

#include <algorithm>
#include <utility>

#include "fuzz/parallel.hpp"
#include "fuzz/trial/certified.hpp"
#include "reports/statistics/failure.hpp"

namespace nearmiss {

namespace {

/// While queries are being asked, shrinking takes at most this part of all processors' time.
constexpr double share = 0.1;

}  // namespace

Shrinking::Shrinking(const Subjects& subjects, int jobs, const Stop& stop, bool enabled)
    : shrinker_(pointers_to(subjects), stop, limits_in_campaign),
      jobs_(jobs),
      stop_(stop),
      enabled_(enabled) {
  threads_.reserve(static_cast<std::size_t>(jobs));
}

Shrinking::~Shrinking() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  has_changed_.notify_all();
  for (std::thread& each : threads_) each.join();
}

void Shrinking::sift(TrialResult& result) {
  std::erase_if(result.findings, [&](const Finding& finding) {
    const std::size_t nth = first_.count(finding);
    if (nth <= findings_kept) add(finding, nth);
    return nth > findings_kept;
  });
  for (Finding& finding : result.findings) finding.certificate = certificate_of(finding);
  result.shrunk = take();
}

void Shrinking::add(const Finding& finding, std::size_t nth) {
  const std::size_t number = count_++;
  if (!enabled_ || finding.is_shrunk || nth > findings_kept) return;
  {
    const std::lock_guard lock(mutex_);
    waiting_.emplace(Priority{finding.query_class, nth, number}, Task{number, finding});
  }
  has_changed_.notify_all();
  // If the system cannot start a thread now, a later call of add() tries again.
  if (threads_.empty()) start();
}

std::map<std::size_t, Finding> Shrinking::take() {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
  return std::exchange(shrunk_, {});
}

std::size_t Shrinking::left() const {
  const std::lock_guard lock(mutex_);
  return waiting_.size() + under_way_;
}

bool Shrinking::start() {
  std::unique_lock lock(mutex_);
  std::thread thread = start_thread([this] { work(); });
  if (!thread.joinable()) return false;
  threads_.push_back(std::move(thread));
  ++working_;
  return true;
}

void Shrinking::shrink(Task& task) {
  // If the subject fails by exceeding its time limit, every step of shrinking takes as long as this limit.
  // Only `nearmiss shrink` shrinks such findings.
  const bool is_slow = failure_of(signature_of(task.finding)) == FailureKind::slow;
  try {
    if (is_slow)
      task.finding.is_shrunk = true;
    else
      shrinker_.shrink(task.finding, [&] { rest(); });
    task.finding.certificate = certificate_of(task.finding);
    const std::lock_guard lock(mutex_);
    --under_way_;
    shrunk_.emplace(task.number, std::move(task.finding));
  } catch (const Stopped&) {  // the finding stays unshrunk
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
  }
  has_changed_.notify_all();
}

void Shrinking::work() {
  const auto is_over = [&] { return ends_ || stop_.is_due(Stop::grace); };
  std::unique_lock lock(mutex_);
  for (;;) {
    has_changed_.wait(lock, [&] { return !waiting_.empty() || ends_ || is_hurried_; });
    if (waiting_.empty() || is_over()) break;
    Task task = std::move(waiting_.begin()->second);
    waiting_.erase(waiting_.begin());
    ++under_way_;
    busy_since_ = Clock::now();
    lock.unlock();
    shrink(task);
    lock.lock();
    busy_ += Clock::now() - busy_since_;
  }
  --working_;
  has_changed_.notify_all();
}

void Shrinking::rest() {
  std::unique_lock lock(mutex_);
  busy_ += Clock::now() - std::exchange(busy_since_, Clock::now());
  const auto must_wait = [&] {
    return std::chrono::duration<double>(busy_) > share * jobs_ * (Clock::now() - start_);
  };
  while (!ends_ && !is_hurried_ && must_wait()) {
    lock.unlock();
    stop_.check(Stop::grace);
    lock.lock();
    has_changed_.wait_for(lock, std::chrono::milliseconds(10));
  }
  if (ends_) throw Stopped();
  busy_since_ = Clock::now();
}

void Shrinking::finish(const std::function<void()>& report) {
  std::unique_lock lock(mutex_);
  is_hurried_ = true;
  lock.unlock();
  has_changed_.notify_all();
  while (threads_.size() < static_cast<std::size_t>(jobs_) && start()) {
  }
  if (threads_.empty()) {  // the system could not start any thread
    ++working_;
    work();
  }
  lock.lock();
  while (working_ != 0) {
    has_changed_.wait_for(lock, std::chrono::milliseconds(100));
    lock.unlock();
    report();
    lock.lock();
  }
  lock.unlock();
  report();
}

}  // namespace nearmiss
