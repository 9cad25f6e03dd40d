// libFuzzer target: a collision that the subject misses.
#include "fuzz/libfuzzer/query_target.hpp"
#include "fuzz/libfuzzer/untraced.hpp"
#include "oracle/oracle.hpp"

const nearmiss::libfuzzer::Target nearmiss::libfuzzer::target{.takes_separations = true};

void nearmiss::libfuzzer::examine(const Query& query) {
  const Verdict verdict = subject().decide(query);
  if (verdict.fault != Fault::none) return;
  const Query rounded = subject().rounded(query);
  const Decision truth = untraced([&] { return decide(rounded); });
  show(Signal::filter_stage, query.kind, static_cast<std::size_t>(truth.stage));
  show(truth.collision ? Signal::true_stage : Signal::false_stage, query.kind,
       static_cast<std::size_t>(verdict.stage));
  if (!truth.collision) return;
  if (!verdict.hit) fail(Finding::What::false_negative, rounded);
  show_factor(Signal::margin, query.kind, untraced([&] { return subject().needed_tolerance(query); }));
}
