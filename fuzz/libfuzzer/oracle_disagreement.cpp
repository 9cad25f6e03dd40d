// libFuzzer target: a query on which the oracle's methods disagree, or on which the filter's results differ
// between instruction sets.
#include <cstddef>
#include <optional>
#include <span>

#include "fuzz/libfuzzer/query_target.hpp"
#include "oracle/agreement/answers.hpp"
#include "oracle/agreement/checked.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss::libfuzzer {

const Target target{};

namespace {

/// Whether the filter ends at the same stage with every instruction set of this machine, and does not
/// contradict the exact answer `collision`.
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

/// Shows libFuzzer the answers of all methods as numbers. Each method has its own range of numbers.
void show_all(Kind kind, std::span<const Answer> answers) {
  const auto number = [](std::optional<bool> said) { return said ? (*said ? 2U : 1U) : 0U; };
  std::size_t before = 0;
  std::size_t details_before = 0;
  for (const Answer& answer : answers) {
    show(Signal::answers, kind,
         before + 9 * number(answer.collision) + 3 * number(answer.on_boundary) + number(answer.odd));
    show(Signal::details, kind, details_before + answer.detail);
    before += 27;
    details_before += 32;
  }
}

}  // namespace

void examine(const Query& query) {
  const Answers answers = ask_all(query);
  const Decision decision = decide(query);
  show(Signal::filter_stage, query.kind, static_cast<std::size_t>(decision.stage));
  show_all(query.kind, answers.all());
  if (!disagreement(query, decision, answers).empty() || !filter_agrees(query, answers.collision()))
    fail(Finding::What::oracle_disagreement, query);
}

}  // namespace nearmiss::libfuzzer
