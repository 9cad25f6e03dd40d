#include "reports/statistics/counts.hpp"

#include <numeric>

namespace nearmiss {

namespace {

/// The order of cases, farthest first. Ties follow the order of the queries, so that merging in any order
/// keeps the same cases.
bool farther(const FarCase& a, const FarCase& b) {
  if (a.ratio != b.ratio) return a.ratio > b.ratio;
  return std::tie(a.query.kind, a.query.x, a.provenance) < std::tie(b.query.kind, b.query.x, b.provenance);
}

}  // namespace

void add_up(std::vector<FarCase>& own, const std::vector<FarCase>& other) {
  own.insert(own.end(), other.begin(), other.end());
  std::sort(own.begin(), own.end(), farther);
  own.erase(std::unique(own.begin(), own.end()), own.end());
  if (own.size() > Counts::far_cases) own.resize(Counts::far_cases);
}

void Counts::add(const Outcome& outcome, const Query& query, const std::function<std::string()>& provenance) {
  const bool hit = outcome.verdict.hit;
  const auto stage = static_cast<std::size_t>(outcome.verdict.stage);
  ++queries;
  if (outcome.verdict.fault != Fault::none) {
    ++faults[static_cast<std::size_t>(outcome.verdict.fault)];
    return;
  }
  collisions += outcome.collision ? 1 : 0;
  positives += hit ? 1 : 0;
  rejected_by[static_cast<std::size_t>(outcome.verdict.rejection)] += hit ? 0 : 1;
  if (outcome.collision) {
    if (hit)
      ++true_by_stage[stage];
    else
      ++false_negatives;
  } else if (hit) {
    ++false_positives;
    ++false_by_stage[stage];
    distances.add(outcome.ratio);
    refuted_bounds += outcome.bound_refuted ? 1 : 0;
    measured_by_wang += outcome.measured_by_wang ? 1 : 0;
    if (keeps(outcome.ratio)) add_up(farthest, {{outcome.ratio, query, provenance()}});
  }
}

std::uint64_t Counts::faults_total() const {
  return std::accumulate(faults.begin(), faults.end(), std::uint64_t{0});
}

}  // namespace nearmiss
