#include "fuzz/trial/sifted_trials.hpp"

#include <utility>
#include <vector>

#include "fuzz/parallel.hpp"

namespace nearmiss {

TrialResult SiftedTrials::hold(std::size_t count, const std::function<TrialResult(std::size_t)>& trial) {
  std::vector<TrialResult> results(count);
  in_parallel(jobs_, count, [&](std::size_t i) {
    if (!stop_) results[i] = trial(i);
  });
  TrialResult sum;
  for (TrialResult& result : results) sum.merge(std::move(result));
  sieve_.sift(sum.findings);
  return sum;
}

}  // namespace nearmiss
