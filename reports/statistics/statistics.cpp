#include "reports/statistics/statistics.hpp"

#include <functional>
#include <limits>
#include <numeric>

#include "reports/statistics/extreme.hpp"
#include "reports/statistics/family.hpp"
#include "reports/statistics/sums.hpp"

namespace nearmiss {

void CountsSum::add(const std::string& family, const Counts& each) {
  counts.merge(each);
  is_sample = is_sample && is_random(family);
}

namespace {

/// Adds each entry of the second map to the first. Both maps order their keys in the same way, so the place
/// of a key of `other` in `own` is usually right after the place of the previous key.
template <class Entries>
void merge_entries(Entries& own, const Entries& other) {
  auto place = own.begin();
  for (const auto& [key, each] : other) {
    place = own.try_emplace(place, key);
    add_up(place->second, each);
    ++place;
  }
}

}  // namespace

void Statistics::merge(const Statistics& other) {
  merge_entries(oracle, other.oracle);
  merge_entries(counts, other.counts);
  for (const auto& [name, each] : other.extremes)
    if (const auto [own, fresh] = extremes.try_emplace(name, each); !fresh) own->second.merge(each);
  merge_entries(funnels, other.funnels);
  merge_entries(simulated, other.simulated);
  merge_entries(factors, other.factors);
  merge_entries(versions, other.versions);
  merge_entries(seen, other.seen);
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

/// The sum of the results of `count` for the counters of all subjects, kinds and families.
template <class Count>
std::uint64_t sum_of(const std::map<CountsKey, Counts>& counts, const Count& count) {
  return std::accumulate(
      counts.begin(), counts.end(), std::uint64_t{0},
      [&](std::uint64_t sum, const auto& each) { return sum + std::invoke(count, each.second); });
}

}  // namespace

std::uint64_t Statistics::false_negatives() const { return sum_of(counts, &Counts::false_negatives); }
std::uint64_t Statistics::faults() const { return sum_of(counts, &Counts::faults_total); }

void Extreme::merge(const Extreme& other) {
  const bool less = of == Of::keeping_tolerance;
  const bool more_extreme = less ? other.value < value : other.value > value;
  const bool as_extreme =
      other.value == value && other.found() && (!found() || other.provenance < provenance);
  const std::uint64_t sum = queries + other.queries;
  if (more_extreme || as_extreme) *this = other;
  queries = sum;
}

Extreme nothing_found(Extreme::Of of, std::string name) {
  const bool less = of == Extreme::Of::keeping_tolerance;
  return {of, std::move(name), less ? std::numeric_limits<double>::infinity() : 0, {}, {}, 0};
}

}  // namespace nearmiss
