#include "tests/proofs/gappa.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/proofs/lemmas.hpp"

namespace nearmiss::proofs {

GappaAnswer Prover::run(const std::string& script) {
  {
    const std::lock_guard lock(mutex_);
    if (const auto known = known_.find(script); known != known_.end()) return known->second;
  }
  GappaAnswer answer = run_gappa(script);
  const std::lock_guard lock(mutex_);
  return known_.emplace(script, std::move(answer)).first->second;
}

ProvenBounds Prover::bounds(const Problem& problem, const Arithmetic& arithmetic) {
  auto ranges = bounds_in(run(Lemmas(*this, problem, arithmetic).script_of_bounds()).text);
  ProvenBounds bounds{ranges.at("d").magnitude(), 0};
  ranges.erase("d");
  for (const auto& [name, range] : ranges)
    bounds.largest_result = std::max(bounds.largest_result, range.magnitude());
  return bounds;
}

bool Prover::proves(const Problem& problem, const Arithmetic& arithmetic, double bound) {
  return run(script(problem, arithmetic, bound)).proven;
}

std::string Prover::script(const Problem& problem, const Arithmetic& arithmetic, double bound) {
  return Lemmas(*this, problem, arithmetic).last_script(interval(-bound, bound));
}

}  // namespace nearmiss::proofs
