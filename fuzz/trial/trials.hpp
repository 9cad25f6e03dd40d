// Runs many trials on all cores, and keeps and shrinks the first findings of each signature (signatures.hpp)
// and class of queries.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "fuzz/stop.hpp"
#include "fuzz/trial/pace.hpp"
#include "fuzz/trial/shrinking.hpp"
#include "fuzz/trial/so_far.hpp"
#include "fuzz/trial/trial.hpp"

namespace nearmiss {

/// Puts the subjects on trial over a batch, one slice of the batch after the other. After a request to stop,
/// does nothing.
using AskBatch = std::function<void(const Batch&)>;

/// A piece of work, in which one thread asks about some batches, one after the other.
struct Work {
  /// Calls ask(batch) for each batch of the piece; may throw Stopped. If it turns out meanwhile that an
  /// earlier piece sets a subject aside (so_far.hpp), `hold` is called again, and must begin with the first
  /// batch.
  std::function<void(const AskBatch& ask)> hold;
  /// Called after `hold`, in the order of the pieces of work. Returns whether the result of the piece counts.
  /// `complete` is false if a stop interrupted the piece.
  std::function<bool(bool complete)> counts = [](bool /*complete*/) { return true; };
};

/// Runs many trials of the same subjects. Apart from run times, the results do not depend on `jobs`.
class Trials {
 public:
  /// The sink receives results several times a second, in the order of the pieces of work. The results
  /// contain the first findings of each signature and class (FirstFindings). If `shrink` is true, they also
  /// contain the findings that have been shrunk meanwhile. The subjects and `stop` must outlive this object.
  Trials(const Subjects& subjects, Comparison comparison, int jobs, const Stop& stop, bool shrink,
         TrialSink sink);

  [[nodiscard]] const Subjects& subjects() const { return subjects_; }
  [[nodiscard]] const Stop& stop() const { return stop_; }
  [[nodiscard]] int jobs() const { return jobs_; }
  /// The number of queries that a batch should have, so that subjects get as many queries at once as they ask
  /// for. The number is at most 2^16, because each thread stores a batch of its own.
  [[nodiscard]] std::size_t batch_size() const { return batch_size_; }
  /// Chooses how many queries of a family to make at once.
  [[nodiscard]] const Pace& pace() const { return pace_; }
  [[nodiscard]] std::size_t to_shrink() const { return shrinking_.left(); }

  /// Takes over the results of earlier runs. The sink does not receive these results.
  void resume(const Statistics& before, const std::vector<Finding>& findings);

  /// Calls next() for one piece of work after the other, and does it, until next() returns nothing or the
  /// stop is due.
  void run(const std::function<std::optional<Work>()>& next);

  /// Adds a result that is known without a trial.
  void add(TrialResult&& result);

  /// Passes on to the sink the results that have come since the last call.
  void pass_on();

  /// Shrinks the findings that are not shrunk yet, and passes them on to the sink. Meanwhile, calls `report`
  /// several times a second.
  void finish(const std::function<void()>& report = [] {});

 private:
  using Clock = Stop::Clock;
  struct OnItsWay;

  void hold(OnItsWay& item);
  void ask(OnItsWay& item, const Batch& batch);
  void take(OnItsWay& item);
  std::vector<Known> known_before(OnItsWay& item, const Batch& batch) const;
  [[nodiscard]] bool knew_enough(const OnItsWay& item) const;
  void pass_on_now_and_then();

  const Subjects& subjects_;
  Comparison comparison_;
  int jobs_;
  const Stop& stop_;
  TrialSink sink_;
  std::size_t batch_size_;
  Pace pace_;
  SoFar so_far_;
  Shrinking shrinking_;
  TrialResult sum_;  // not passed on yet
  Clock::time_point passed_on_ = Clock::now();
};

}  // namespace nearmiss
