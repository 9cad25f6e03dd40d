// Trials over queries that come one at a time, such as a corpus.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "fuzz/trial/trials.hpp"

namespace nearmiss {

/// Collects queries into batches, and runs the trials of the batches. The queries of a batch have the same
/// kind and the same family, and either all or none of them have a separation. A TrialStream stores only a
/// few batches at any time. Subjects are not timed, because a few queries say nothing about a subject's
/// speed.
class TrialStream {
 public:
  explicit TrialStream(Trials& trials) : trials_(trials) {}

  /// Adds a query; returns false after a request to stop. `provenance` is called only if the query is kept,
  /// and never after finish(). Throws Error if a coordinate is not finite, as hold_trial does.
  bool add(const std::string& family, const Query& query, std::optional<bool> truth,
           std::function<std::string()> provenance);

  /// Runs the trials of the queries that have not been on trial yet. If a stop was requested, does not run
  /// them.
  void finish();

 private:
  struct Pending {
    Batch batch;
    std::vector<std::function<std::string()>> provenances;
  };

  void hold_trials();

  Trials& trials_;
  std::map<std::tuple<std::string, Kind, bool>, Pending> pending_;  // by family, kind and whether h > 0
  std::vector<Pending> full_;
  std::uint64_t batches_ = 0;  ///< the number of batches that have been made so far
};

}  // namespace nearmiss
