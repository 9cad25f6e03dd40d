// Sets subjects aside that exceed their time limit again and again.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <utility>

#include "fuzz/trial/trial.hpp"

namespace nearmiss {

/// A subject that has exceeded its time limit `most_late` times in a family is not asked about later queries of that
/// family and kind. Trials run in any order, but what counts is decided in their order. Many threads use it at once.
class Patience {
 public:
  static constexpr std::uint64_t most_late = 3;

  /// Counts the queries over the time limit of an earlier run.
  void know(const Statistics& before);

  /// Asks the subjects of a trial, except those that are known to have been set aside before it. `number` is the place
  /// of the trial in the order.
  void ask(Trial& trial, std::uint64_t number);

  /// Must be called in the order of the trials. Removes the answers of subjects that had been set aside; returns whether
  /// there were any.
  bool settle(Trial& trial, std::uint64_t number);

 private:
  /// The numbers of trials on their way with a query over the time limit, each once for every such query.
  using Late = std::multiset<std::uint64_t>;

  [[nodiscard]] bool asks(const CountsKey& key, std::uint64_t number) const;

  mutable std::mutex mutex_;
  std::map<CountsKey, std::uint64_t> settled_;
  std::map<CountsKey, Late> on_their_way_;
};

/// Whether a subject with these counts is set aside.
inline bool is_set_aside(const Counts& counts) {
  return counts.faults[static_cast<std::size_t>(Fault::time)] >= Patience::most_late;
}

}  // namespace nearmiss
