// Ends long work at a request or a time limit.
#pragma once

#include <atomic>
#include <chrono>

namespace nearmiss {

/// Thrown by work that ends before it is done, because its `Stop` is due.
struct Stopped {};

/// Says when work must end: when the end is requested, or when the time limit has passed. Many threads may
/// ask at once.
class Stop {
 public:
  using Clock = std::chrono::steady_clock;

  /// `requested` must outlive the Stop.
  explicit Stop(const std::atomic<bool>& requested) : requested_(requested) {}

  /// The time that a trial grants beyond its time limit, to shrink the last findings.
  static constexpr std::chrono::milliseconds grace{1000};

  /// A Stop that is never due.
  static const Stop& never() {
    static const std::atomic<bool> no{false};
    static const Stop never(no);
    return never;
  }

  /// Makes this Stop due after `time`, counted from now. Must be called before other threads use this Stop.
  void limit(std::chrono::duration<double> time) {
    // A time that is longer than the clock can represent is no limit.
    constexpr std::chrono::hours longest{24 * 365 * 10};
    if (time < longest) end_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(time);
  }

  [[nodiscard]] bool is_requested() const { return requested_; }
  /// Whether the work must end. `granted` extends the time limit, but does not delay a requested end.
  [[nodiscard]] bool is_due(std::chrono::milliseconds granted = {}) const {
    return requested_ || (end_ != Clock::time_point::max() && Clock::now() >= end_ + granted);
  }
  /// Throws Stopped if the work must end.
  void check(std::chrono::milliseconds granted = {}) const {
    if (is_due(granted)) throw Stopped();
  }

 private:
  const std::atomic<bool>& requested_;
  Clock::time_point end_ = Clock::time_point::max();
};

}  // namespace nearmiss
