// Trials over queries that come one at a time, such as a corpus or the pairs of a scene.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fuzz/failures/sieve.hpp"
#include "fuzz/trial.hpp"

namespace nearmiss {

/// Collects queries into batches by kind and family, holds the trials on all cores, and passes the results
/// on. Only a few batches are held at any time. The results do not depend on `jobs`, but for times.
class TrialStream {
 public:
  /// Takes the result of some batches, in order, findings sifted (sieve.hpp).
  using Sink = std::function<void(TrialResult&&)>;

  TrialStream(const Subjects& subjects, const Comparison& comparison, int jobs, const std::atomic<bool>& stop,
              Sink sink);

  /// Takes a query; false once `stop` is set. `provenance` is called, until finish(), only for what is kept.
  /// Throws Error as hold_trial does.
  bool add(const std::string& family, const Query& query, std::optional<bool> truth,
           std::function<std::string()> provenance);

  /// Decides what is still held. Queries that came before `stop` was set but are not decided yet are left
  /// out.
  void finish();

 private:
  struct Pending {
    Batch batch;
    std::vector<std::function<std::string()>> provenances;
  };

  void hold_trials();

  const Subjects& subjects_;
  Comparison comparison_;
  int jobs_;
  const std::atomic<bool>& stop_;
  Sink sink_;
  Sieve sieve_;
  std::map<std::pair<std::string, Kind>, Pending> pending_;
  std::vector<Pending> full_;
};

}  // namespace nearmiss
