// The failure-proof CCD `wang`, used as a header-only library. Built-in subjects have a guard that sets the
// mode of arithmetic; this CCD runs without that guard.
#include "ccd/wang/wang.hpp"

#include "ccd/subjects/subject.hpp"
#include "fuzz/studies/environments/on_trial.hpp"

namespace nearmiss::environments {

bool collides(const Query& query) {
  constexpr WangOptions of_wang;
  return with_kind(query.kind, [&]<Kind kind>() { return wang<kind, double, of_wang>(query).hit; });
}

double distance_bound(const Query& query) { return make_subject("wang")->distance_bound(query); }

}  // namespace nearmiss::environments
