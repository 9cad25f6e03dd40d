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

double Prover::error(const Problem& problem, const Arithmetic& arithmetic) {
  Lemmas lemmas(*this, problem, arithmetic);
  const auto results = bounds_in(run(lemmas.last_script("?")).text);
  return results.at("d").magnitude();
}

double Prover::largest_result(const Problem& problem, const Arithmetic& arithmetic) {
  Lemmas lemmas(*this, problem, arithmetic);
  double largest = 0;
  for (const auto& [name, bounds] : bounds_in(run(lemmas.range_script()).text))
    largest = std::max(largest, bounds.magnitude());
  return largest;
}

bool Prover::proves(const Problem& problem, const Arithmetic& arithmetic, double bound) {
  return run(script(problem, arithmetic, bound)).proven;
}

std::string Prover::script(const Problem& problem, const Arithmetic& arithmetic, double bound) {
  Lemmas lemmas(*this, problem, arithmetic);
  return lemmas.last_script(interval(-bound, bound));
}

}  // namespace nearmiss::proofs
