#include "reports/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "reports/quantile.hpp"

namespace nearmiss {

double Histogram::border(std::size_t i) {
  if (i == 0) return 0;
  if (i == bin_count) return std::numeric_limits<double>::infinity();
  return std::pow(10.0, lowest_decade + static_cast<double>(i - 1) / per_decade);
}

namespace {

/// The borders decide, not a logarithm, so that a ratio of 1 is never counted below the bound.
std::size_t bin_of(double ratio) {
  static const auto borders = [] {
    std::array<double, Histogram::bin_count - 1> inner{};
    for (std::size_t i = 0; i < inner.size(); ++i) inner[i] = Histogram::border(i + 1);
    return inner;
  }();
  return static_cast<std::size_t>(std::upper_bound(borders.begin(), borders.end(), ratio) - borders.begin());
}

}  // namespace

double Histogram::lower_border(double ratio) { return border(bin_of(ratio)); }

void Histogram::add(double ratio) { ++bins[bin_of(ratio)]; }

void Histogram::merge(const Histogram& other) {
  for (std::size_t i = 0; i < bin_count; ++i) bins[i] += other.bins[i];
}

std::uint64_t Histogram::at_least_one() const {
  return std::accumulate(bins.begin() + static_cast<std::ptrdiff_t>(bin_of(1)), bins.end(), std::uint64_t{0});
}

Bin Histogram::quantile(double part) const {
  const auto bin = quantile_bin(bins, part);
  if (bin == bins.end()) return {};
  const auto i = static_cast<std::size_t>(bin - bins.begin());
  return {border(i), border(i + 1)};
}

namespace {

/// Farthest first; ties in the order of the queries, so that merging in any order keeps the same cases.
bool farther(const FarCase& a, const FarCase& b) {
  if (a.ratio != b.ratio) return a.ratio > b.ratio;
  return std::tie(a.query.kind, a.query.x, a.provenance) < std::tie(b.query.kind, b.query.x, b.provenance);
}

void keep_farthest(std::vector<FarCase>& cases) {
  std::sort(cases.begin(), cases.end(), farther);
  cases.erase(std::unique(cases.begin(), cases.end()), cases.end());
  if (cases.size() > Counts::far_cases) cases.resize(Counts::far_cases);
}

}  // namespace

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
    if (keeps(outcome.ratio)) {
      farthest.push_back({outcome.ratio, query, provenance()});
      keep_farthest(farthest);
    }
  }
}

std::uint64_t Counts::faults_total() const {
  return std::accumulate(faults.begin(), faults.end(), std::uint64_t{0});
}

void Counts::merge(const Counts& other) {
  queries += other.queries;
  collisions += other.collisions;
  positives += other.positives;
  false_negatives += other.false_negatives;
  false_positives += other.false_positives;
  refuted_bounds += other.refuted_bounds;
  for (std::size_t i = 0; i < stage_count; ++i) {
    true_by_stage[i] += other.true_by_stage[i];
    false_by_stage[i] += other.false_by_stage[i];
  }
  for (std::size_t i = 0; i < rejection_count; ++i) rejected_by[i] += other.rejected_by[i];
  distances.merge(other.distances);
  farthest.insert(farthest.end(), other.farthest.begin(), other.farthest.end());
  keep_farthest(farthest);
  for (std::size_t i = 0; i < fault_count; ++i) faults[i] += other.faults[i];
  times.merge(other.times);
  is_sample = is_sample && other.is_sample;
}

bool is_random(std::string_view family) { return !family.ends_with('/') && !family.starts_with("scene:"); }

void OracleCounts::merge(const OracleCounts& other) {
  queries += other.queries;
  collisions += other.collisions;
  for (std::size_t i = 0; i < filter_stage_count; ++i) by_stage[i] += other.by_stage[i];
  near_bounds += other.near_bounds;
  compared += other.compared;
  compared_collisions += other.compared_collisions;
  missed_by_parity += other.missed_by_parity;
}

void Statistics::merge(const Statistics& other) {
  for (const auto& [key, each] : other.oracle) oracle[key].merge(each);
  for (const auto& [key, each] : other.counts) counts[key].merge(each);
  for (const auto& [name, each] : other.extremes)
    if (const auto [own, fresh] = extremes.try_emplace(name, each); !fresh) own->second.merge(each);
  for (const auto& [key, each] : other.funnels) funnels[key].merge(each);
  for (const auto& [signature, count] : other.seen) seen[signature] += count;
  oracle_disagreements += other.oracle_disagreements;
  mismatches_with_recorded_truth += other.mismatches_with_recorded_truth;
}

std::map<Key, Counts> Statistics::by_subject_and_kind() const {
  std::map<Key, Counts> sums;
  for (const auto& [key, each] : counts) sums[{key.subject, key.kind, ""}].merge(each);
  return sums;
}

OracleCounts Statistics::oracle_total() const {
  OracleCounts sum;
  for (const auto& [key, each] : oracle) sum.merge(each);
  return sum;
}

std::uint64_t Statistics::times_seen(const Signature& signature) const {
  const auto it = seen.find(signature);
  return it == seen.end() ? 0 : it->second;
}

std::uint64_t Statistics::queries_of(const std::string& subject) const {
  std::uint64_t queries = 0;
  for (const auto& [key, each] : counts)
    if (key.subject == subject) queries += each.queries;
  return queries;
}

namespace {

/// The sum over all counters of what `count` gives of one.
template <class Count>
std::uint64_t sum_of(const std::map<Key, Counts>& counts, const Count& count) {
  return std::accumulate(
      counts.begin(), counts.end(), std::uint64_t{0},
      [&](std::uint64_t sum, const auto& each) { return sum + std::invoke(count, each.second); });
}

}  // namespace

std::uint64_t Statistics::false_negatives() const { return sum_of(counts, &Counts::false_negatives); }
std::uint64_t Statistics::refuted_bounds() const { return sum_of(counts, &Counts::refuted_bounds); }
std::uint64_t Statistics::faults() const { return sum_of(counts, &Counts::faults_total); }

std::string_view name(Finding::What what) {
  switch (what) {
    case Finding::What::false_negative:
      return "false-negative";
    case Finding::What::refuted_bound:
      return "refuted-bound";
    case Finding::What::oracle_disagreement:
      return "oracle-disagreement";
    case Finding::What::truth_mismatch:
      return "truth-mismatch";
    case Finding::What::fault:
      return "fault";
  }
  return "";
}

}  // namespace nearmiss
