#include "fuzz/trial/shrinking.hpp"

#include <algorithm>
#include <utility>

#include "fuzz/parallel.hpp"
#include "fuzz/trial/signatures.hpp"

namespace nearmiss {

namespace {

/// The part of all processors' time that shrinking takes while there is something to ask.
constexpr double share = 0.1;

}  // namespace

Shrinking::Shrinking(const Subjects& subjects, int jobs, const Stop& stop, std::size_t of_each)
    : shrinker_(pointers_to(subjects), stop, limits_in_campaign),
      jobs_(jobs),
      stop_(stop),
      of_each_(of_each) {}

Shrinking::~Shrinking() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  has_changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Shrinking::add(const Finding& finding) {
  const std::size_t number = count_++;
  const std::size_t nth = ++added_[{signature_of(finding), finding.query_class, finding.broken_since}];
  if (finding.is_shrunk || nth > of_each_) return;
  {
    const std::lock_guard lock(mutex_);
    waiting_.emplace(Priority{finding.query_class, nth, number}, Task{number, finding});
  }
  has_changed_.notify_all();
  if (!thread_.joinable()) thread_ = std::thread([this] { work(); });
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
  if (waiting_.empty() || stop_.is_due(Stop::grace)) return std::nullopt;
  Task task = std::move(waiting_.begin()->second);
  waiting_.erase(waiting_.begin());
  ++under_way_;
  return task;
}

void Shrinking::shrink(Task& task, const FindingShrinker::Rest& rest) {
  // Every step would take as long as the time limit. `nearmiss shrink` does it.
  const bool is_slow = task.finding.what == Finding::What::fault && is_of_time_limit(task.finding.signature);
  try {
    if (is_slow)
      task.finding.is_shrunk = true;
    else
      shrinker_.shrink(task.finding, rest);
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
  const auto waits = [&] { return waiting_.empty() && !ends_ && !is_hurried_; };
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      has_changed_.wait(lock, [&] { return !waits(); });
      if (ends_ || is_hurried_) return;
      busy_since_ = Clock::now();
    }
    auto task = next();
    if (!task) return;  // the time is over
    shrink(*task, [&] { rest(); });
    busy_ += Clock::now() - busy_since_;
  }
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
  {
    const std::lock_guard lock(mutex_);
    is_hurried_ = true;
  }
  has_changed_.notify_all();
  in_order<Task>(
      jobs_, [&] { return next(); }, [&](Task& task) { shrink(task); }, [&](Task& /*task*/) { report(); });
  if (thread_.joinable()) thread_.join();
  report();
}

}  // namespace nearmiss
