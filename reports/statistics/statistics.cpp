#include "reports/statistics/statistics.hpp"

#include <functional>
#include <numeric>

#include "reports/statistics/family.hpp"
#include "reports/statistics/sums.hpp"

namespace nearmiss {

void CountsSum::add(const std::string& family, const Counts& each) {
  counts.merge(each);
  is_sample = is_sample && is_random(family);
}

void Statistics::merge(const Statistics& other) {
  for (const auto& [key, each] : other.oracle) oracle[key].merge(each);
  for (const auto& [key, each] : other.counts) counts[key].merge(each);
  for (const auto& [name, each] : other.extremes)
    if (const auto [own, fresh] = extremes.try_emplace(name, each); !fresh) own->second.merge(each);
  for (const auto& [key, each] : other.funnels) funnels[key].merge(each);
  for (const auto& [key, each] : other.simulated) simulated[key].merge(each);
  for (const auto& [key, each] : other.factors) factors[key].merge(each);
  for (const auto& [key, each] : other.versions) versions[key].merge(each);
  for (const auto& [signature, count] : other.seen) seen[signature] += count;
  merge_counters(*this, other);
}

std::map<CountsKey, CountsSum> Statistics::by_subject_and_kind() const {
  return sums_by(*this, [](const CountsKey& key) { return CountsKey{key.subject, key.kind, ""}; });
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

/// The sum of `count` over all counters.
template <class Count>
std::uint64_t sum_of(const std::map<CountsKey, Counts>& counts, const Count& count) {
  return std::accumulate(
      counts.begin(), counts.end(), std::uint64_t{0},
      [&](std::uint64_t sum, const auto& each) { return sum + std::invoke(count, each.second); });
}

}  // namespace

std::uint64_t Statistics::false_negatives() const { return sum_of(counts, &Counts::false_negatives); }
std::uint64_t Statistics::refuted_bounds() const { return sum_of(counts, &Counts::refuted_bounds); }
std::uint64_t Statistics::faults() const { return sum_of(counts, &Counts::faults_total); }

}  // namespace nearmiss
