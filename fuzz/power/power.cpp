#include "fuzz/power/power.hpp"

#include <algorithm>

namespace nearmiss {

std::optional<FirstFailure> find_first_failure(const CampaignPlan& plan, const Subjects& subjects,
                                               const std::atomic<bool>& stop) {
  std::optional<FirstFailure> first;
  run_campaign(
      plan, subjects,
      [&](TrialResult&& result, const CampaignProgress& now) {
        const auto found = std::find_if(result.findings.begin(), result.findings.end(), [](const Finding& f) {
          return f.what == Finding::What::false_negative || f.what == Finding::What::refuted_bound;
        });
        if (found == result.findings.end()) return true;
        first = {std::move(*found), now.elapsed.count(), now.cases};
        return false;
      },
      stop);
  return first;
}

}  // namespace nearmiss
