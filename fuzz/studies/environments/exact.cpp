// The oracle as the CCD `exact`. As in a campaign, the oracle first tries to decide each query with its batch
// filter.
#include <span>

#include "fuzz/studies/environments/on_trial.hpp"
#include "fuzz/subjects/exact.hpp"

namespace nearmiss::environments {

bool collides(const Query& query) {
  static const auto exact = try_make_exact("exact");
  Verdict verdict;
  exact->decide(std::span(&query, 1), std::span(&verdict, 1));
  return verdict.hit;
}

double distance_bound(const Query& /*query*/) { return 0; }

}  // namespace nearmiss::environments
