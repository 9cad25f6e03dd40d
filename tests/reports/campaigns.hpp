// Makes campaigns for reports from a few numbers.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "reports/campaign/campaign.hpp"

namespace nearmiss::testing {

/// Counters of a subject; `ns` is its run time per query. The farthest false positive has the ratio
/// `false_positives` / 1000.
inline Counts counts(std::uint64_t queries, std::uint64_t collisions, std::uint64_t missed,
                     std::uint64_t false_positives, std::uint64_t ns = 0) {
  Counts c;
  c.queries = queries;
  c.collisions = collisions;
  c.false_negatives = missed;
  c.false_positives = false_positives;
  if (ns != 0) c.times.add(Kind::edge_edge, "f", {queries, ns * queries});
  if (false_positives != 0) c.farthest.push_back({1e-3 * static_cast<double>(false_positives), {}, "f:1:0"});
  return c;
}

inline Campaign campaign(const std::string& seed, std::map<CountsKey, Counts> all) {
  Campaign result;
  result.runs.push_back({{{"command", "fuzz"}, {"seed", seed}}, {{}}, {}});
  result.statistics.counts = std::move(all);
  return result;
}

}  // namespace nearmiss::testing
