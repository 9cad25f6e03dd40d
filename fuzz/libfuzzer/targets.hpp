// The targets that hunt for broken promises of a subject.
#pragma once

#include <string_view>
#include <vector>

#include "ccd/subjects/subject.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss::libfuzzer {

struct PromiseTarget {
  std::string_view name;
  Finding::What finds;
};

/// The targets for a subject, one for each of its promises. Every subject promises that it misses no
/// collision. A subject may also promise that its times are lower bounds of the time of impact, and that its
/// false positives stay within a distance bound.
inline std::vector<PromiseTarget> targets_for(const Subject& subject) {
  std::vector<PromiseTarget> targets{{"false_negative", Finding::What::false_negative}};
  if (is_lower_bound(subject.time_sort())) targets.push_back({"late", Finding::What::late});
  if (subject.claims_bound()) targets.push_back({"refuted_bound", Finding::What::refuted_bound});
  return targets;
}

}  // namespace nearmiss::libfuzzer
