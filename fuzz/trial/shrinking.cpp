#include "fuzz/trial/shrinking.hpp"

#include <algorithm>
#include <utility>

#include "fuzz/parallel.hpp"
#include "fuzz/trial/certified.hpp"
#include "reports/statistics/failure.hpp"

namespace nearmiss {

namespace {

/// The part of all processors' time that shrinking takes while there is something to ask.
constexpr double share = 0.1;

}  // namespace

Shrinking::Shrinking(const Subjects& subjects, int jobs, const Stop& stop, bool enabled)
    : shrinker_(pointers_to(subjects), stop, limits_in_campaign),
      jobs_(jobs),
      stop_(stop),
      enabled_(enabled) {}

Shrinking::~Shrinking() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  has_changed_.notify_all();
  if (thread_.joinable()) thread_.join();
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
  if (!thread_.joinable()) thread_ = start_thread([this] { work(); });  // else tried again later
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

std::optional<Shrinking::Task> Shrinking::next() {
  const std::lock_guard lock(mutex_);
  if (waiting_.empty() || ends_ || stop_.is_due(Stop::grace)) return std::nullopt;
  Task task = std::move(waiting_.begin()->second);
  waiting_.erase(waiting_.begin());
  ++under_way_;
  return task;
}

void Shrinking::shrink(Task& task, const FindingShrinker::Rest& rest) {
  // For a query over the time limit, every step would take as long as that limit. Only `nearmiss shrink`
  // shrinks such findings.
  const bool is_slow = failure_of(signature_of(task.finding)) == FailureKind::slow;
  try {
    if (is_slow)
      task.finding.is_shrunk = true;
    else
      shrinker_.shrink(task.finding, rest);
    task.finding.certificate = certificate_of(task.finding);
    const std::lock_guard lock(mutex_);
    --under_way_;
    shrunk_.emplace(task.number, std::move(task.finding));
  } catch (const Stopped&) {  // the finding stays as it is
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
  }
  has_changed_.notify_all();
}

void Shrinking::work() {
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      has_changed_.wait(lock, [&] { return !waiting_.empty() || ends_ || is_hurried_; });
      if (ends_) return;
      if (is_hurried_) break;
      busy_since_ = Clock::now();
    }
    if (auto task = next()) {
      shrink(*task, [&] { rest(); });
      busy_ += Clock::now() - busy_since_;
    } else {  // the time is over
      std::unique_lock lock(mutex_);
      has_changed_.wait(lock, [&] { return ends_ || is_hurried_; });
    }
  }
  work_hurriedly();
}

void Shrinking::work_hurriedly() {
  while (auto task = next()) shrink(*task);
  const std::lock_guard lock(mutex_);
  --hurrying_;
  has_changed_.notify_all();
}

void Shrinking::rest() {
  busy_ += Clock::now() - std::exchange(busy_since_, Clock::now());
  const auto must_wait = [&] {
    return std::chrono::duration<double>(busy_) > share * jobs_ * (Clock::now() - start_);
  };
  std::unique_lock lock(mutex_);
  while (must_wait() && !is_hurried_) {
    if (ends_) throw Stopped();
    lock.unlock();
    stop_.check(Stop::grace);
    lock.lock();
    has_changed_.wait_for(lock, std::chrono::milliseconds(10));
  }
  if (ends_) throw Stopped();
  busy_since_ = Clock::now();
}

void Shrinking::finish(const std::function<void()>& report) {
  std::vector<std::thread> others;
  others.reserve(static_cast<std::size_t>(jobs_));
  const auto end = [&] {
    for (std::thread& each : others)
      if (each.joinable()) each.join();
    if (thread_.joinable()) thread_.join();
  };
  std::unique_lock lock(mutex_);
  is_hurried_ = true;
  hurrying_ = thread_.joinable() ? 1 : 0;
  has_changed_.notify_all();
  while (hurrying_ < jobs_) {
    others.push_back(start_thread([this] { work_hurriedly(); }));
    if (!others.back().joinable()) break;
    ++hurrying_;
  }
  if (hurrying_ == 0) {  // the system has no thread left
    ++hurrying_;
    lock.unlock();
    work_hurriedly();
    lock.lock();
  }
  try {
    while (hurrying_ != 0) {
      has_changed_.wait_for(lock, std::chrono::milliseconds(100));
      lock.unlock();
      report();
      lock.lock();
    }
  } catch (...) {
    if (!lock.owns_lock()) lock.lock();
    ends_ = true;
    lock.unlock();
    end();
    throw;
  }
  lock.unlock();
  end();
  report();
}

}  // namespace nearmiss
