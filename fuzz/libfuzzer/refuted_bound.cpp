// libFuzzer target: a false positive whose distance exceeds the bound that the subject claims.
#include <cmath>

#include "fuzz/libfuzzer/query_target.hpp"
#include "fuzz/libfuzzer/untraced.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"

const nearmiss::libfuzzer::Target nearmiss::libfuzzer::target{.takes_separations = true};

void nearmiss::libfuzzer::examine(const Query& query) {
  const Verdict verdict = subject().decide(query);
  if (!verdict.hit || verdict.fault != Fault::none) return;
  const Query rounded = subject().rounded(query);
  const Decision truth = untraced([&] { return decide(rounded); });
  show(Signal::filter_stage, query.kind, static_cast<std::size_t>(truth.stage));
  show(truth.collision ? Signal::true_stage : Signal::false_stage, query.kind,
       static_cast<std::size_t>(verdict.stage));
  if (truth.collision) return;
  const double bound = subject().distance_bound(rounded);
  if (!std::isfinite(bound)) return;  // the subject claims no bound
  const double ratio = untraced([&] { return closest_ratio(rounded, bound); });
  if (ratio >= 1 && untraced([&] { return distance_exceeds_separation_by(rounded, bound); }))
    fail(Finding::What::refuted_bound, rounded, ratio);
  show_factor(Signal::distance, query.kind, ratio);
}
