// libFuzzer target: a time of impact that is too late, from a subject that promises lower bounds.
#include <algorithm>
#include <cmath>

#include "fuzz/libfuzzer/query_target.hpp"
#include "fuzz/libfuzzer/untraced.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss::libfuzzer {

const Target target{.subject = "wang-time", .needs_lower_bounds = true, .takes_separations = true};

namespace {

/// A measure of how near a time is to t*, the exact earliest time. The number grows by two whenever (t* -
/// time) / t* halves.
std::size_t common_digits(double time, EarliestTime& earliest) {
  Enclosure known = earliest.known();
  if (time >= known.lo) known = earliest.enclosure();
  const double before = std::max(known.lo - time, 0.0) / known.hi;
  return before > 0 ? static_cast<std::size_t>(-2 * std::log2(std::clamp(before, 0x1p-60, 1.0))) : 120;
}

}  // namespace

void examine(const Query& query) {
  const Verdict verdict = subject().decide(query);
  if (!verdict.hit || std::isnan(verdict.time)) return;
  const Query rounded = subject().rounded(query);
  auto earliest = untraced([&] { return earliest_time(rounded); });
  show(earliest ? Signal::true_stage : Signal::false_stage, query.kind,
       static_cast<std::size_t>(verdict.stage));
  if (!earliest) return;
  if (untraced([&] { return earliest->makes_late(verdict.time); })) fail(Finding::What::late, rounded);
  show(Signal::agreement, query.kind, untraced([&] { return common_digits(verdict.time, *earliest); }));
}

}  // namespace nearmiss::libfuzzer
