// libFuzzer: a query about which the oracle's answers, or those of its filter, are not the same.
#include <array>
#include <span>

#include "fuzz/libfuzzer/query_target.hpp"
#include "oracle/agreement.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss::libfuzzer {

namespace {

/// Whether the filter, by all instructions of this machine, decides alike and as exact arithmetic does.
bool filter_agrees(const Query& query, bool collision) {
  const std::span<const Query> queries(&query, 1);
  const auto contradicts = [&](FilterStage stage) {
    return stage != FilterStage::undecided && is_collision(stage) != collision;
  };
  FilterStage first{};
  filter(queries, {&first, 1}, Instructions::sse2);
  for (const auto wider : {Instructions::avx2, Instructions::avx512}) {
    FilterStage stage = first;
    if (has(wider)) filter(queries, {&stage, 1}, wider);
    if (stage != first) return false;
  }
  return !contradicts(first) && !contradicts(filter(query));
}

}  // namespace

void examine(const Query& query) {
  const Answers answers = ask_all(query);
  const Decision decision = decide(query);
  const auto& [exact, sturm, parity] = answers;
  show(Signal::filter_stage, query.kind, static_cast<std::size_t>(decision.stage));
  std::size_t said = 0;
  for (const bool answer : {exact, sturm.planar, sturm.on_boundary, parity.odd})
    said = 2 * said + (answer ? 1 : 0);
  show(Signal::answers, query.kind, said);
  show(Signal::roots, query.kind, static_cast<std::size_t>(4 * sturm.with_multiplicity + sturm.distinct));
  if (!answers.agree() || exact != decision.collision || !filter_agrees(query, exact))
    fail(Finding::What::oracle_disagreement, query);
}

}  // namespace nearmiss::libfuzzer
