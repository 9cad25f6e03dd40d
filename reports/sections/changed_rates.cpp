#include "reports/sections/baseline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "corpus/query_text.hpp"
#include "reports/statistics/failure.hpp"
#include "reports/statistics/family.hpp"

namespace nearmiss {

namespace {

constexpr std::string_view beyond_the_bound = "false positives beyond the bound";
constexpr std::string_view beyond_wangs_bound = "false positives beyond wang's bound (no claim)";

/// The rates of one subject, kind and family that are compared with those of other campaigns.
std::vector<std::pair<std::string_view, Proportion>> rates_of(const Counts& counts) {
  return {{"false negatives", {counts.false_negatives, counts.collisions}},
          {"false positives", {counts.false_positives, counts.others()}},
          {"late times", {counts.late, counts.times_promised}},
          {beyond_the_bound, {counts.distances.at_least_one(), counts.others()}},
          {"no answer", {counts.faults_total(), counts.queries}}};
}

/// Adds up the proportions of several campaigns. Leaves out each proportion that differs from the last one by
/// more than chance explains.
Proportion like_the_last(const std::vector<Proportion>& all, double risk) {
  Proportion sum;
  for (const Proportion& each : all)
    if (fisher_test(all.back(), each).either() >= risk / static_cast<double>(all.size())) sum += each;
  return sum;
}

/// All rates that a campaign and its baseline have in common, whether the rates have changed or not.
std::vector<ChangedRate> pairs_of_rates(const Statistics& now, std::span<const Campaign> baseline,
                                        double risk) {
  std::vector<ChangedRate> pairs;
  for (const auto& [key, counts] : now.counts) {
    if (!is_random(key.family) || is_beyond_contract(key.subject)) continue;
    const auto rates = rates_of(counts);
    std::vector<std::vector<Proportion>> earlier(rates.size());
    for (const Campaign& each : baseline)
      if (const auto found = each.statistics.counts.find(key); found != each.statistics.counts.end()) {
        const auto earlier_rates = rates_of(found->second);
        for (std::size_t i = 0; i < rates.size(); ++i)
          if (earlier_rates[i].second.total != 0) earlier[i].push_back(earlier_rates[i].second);
      }
    for (std::size_t i = 0; i < rates.size(); ++i)
      if (rates[i].second.total != 0 && !earlier[i].empty())
        pairs.push_back({rates[i].first, key.subject, std::string(short_name(key.kind)), key.family,
                         like_the_last(earlier[i], risk), rates[i].second});
  }
  for (ChangedRate& each : pairs) each.p = fisher_test(each.now, each.before).either();
  return pairs;
}

/// Thresholds: a pair of a family and a kind has few failures if it has at most this number. There are three
/// thresholds, because larger campaigns have more failures; rates_where_few() tries all of them.
constexpr std::array<std::uint64_t, 3> fews{5, 20, 80};

/// A subject and the name of one of its rates.
using RateName = std::pair<std::string, std::string_view>;

/// The proportions {now, before} of one rate, for several pairs of a family and a kind. `kinds` has the bits
/// of the kinds in these pairs.
struct FewFailures {
  std::vector<std::pair<Proportion, Proportion>> proportions;
  int kinds = 0;
};

/// For each rate, the pairs of a family and a kind that have 1 to `few` failures in the campaign and its
/// baseline together. The steps of a sweep (a family with different values of its parameter) share their
/// draws, so they are not independent samples. Therefore only the step with the most failures is included.
/// Pairs are selected by the sum of the two counts, which favours neither the campaign nor the baseline. So a
/// test of the selected pairs stays valid.
std::map<RateName, FewFailures> pairs_with_few(const std::vector<ChangedRate>& pairs, std::uint64_t few) {
  const auto both = [](const ChangedRate& each) { return each.now.count + each.before.count; };
  std::map<RateName, std::map<std::pair<std::string, std::string>, const ChangedRate*>> chosen;
  for (const ChangedRate& each : pairs) {
    if (both(each) == 0 || both(each) > few) continue;
    const ChangedRate*& place = chosen[{each.subject, each.what}][{each.kind, draws_of(each.family)}];
    if (place == nullptr || both(each) > both(*place)) place = &each;
  }
  std::map<RateName, FewFailures> found;
  for (const auto& [name, by_draws] : chosen)
    for (const auto& [draws, rate] : by_draws) {
      found[name].proportions.emplace_back(rate->now, rate->before);
      found[name].kinds |= bit_of(parse_kind(rate->kind, "a rate"));
    }
  return found;
}

/// The rates of each subject, summed over all families and kinds with few failures. For each rate, takes the
/// threshold in `fews` that gives the smallest p-value, and multiplies this p-value by the number of
/// thresholds.
std::vector<ChangedRate> rates_where_few(const std::vector<ChangedRate>& pairs) {
  std::map<RateName, ChangedRate> best;
  for (const std::uint64_t few : fews)
    for (const auto& [name, failures] : pairs_with_few(pairs, few)) {
      const auto& proportions = failures.proportions;
      if (proportions.size() == 1) continue;  // pairs_of_rates() already compares the rate of a single pair
      ChangedRate sum{name.second,
                      name.first,
                      names_of_kinds(failures.kinds, ", "),
                      fmt::format("families with at most {}", few),
                      {},
                      {}};
      for (const auto& [now, before] : proportions) {
        sum.now += now;
        sum.before += before;
      }
      sum.p = std::min(1.0, fews.size() * pooled_test(proportions).either());
      if (const auto [own, fresh] = best.try_emplace(name, sum); !fresh && sum.p < own->second.p)
        own->second = sum;
    }
  std::vector<ChangedRate> sums;
  for (auto& [name, sum] : best) sums.push_back(std::move(sum));
  return sums;
}

/// For each subject that claims no bound, renames the rate "false positives beyond the bound".
void name_bounds(std::vector<ChangedRate>& rates, const Statistics& now) {
  std::set<std::string> claim_nothing;
  for (const auto& [key, counts] : now.counts)
    if (counts.distance_unit() != DistanceUnit::claimed_bound) claim_nothing.insert(key.subject);
  for (ChangedRate& each : rates)
    if (each.what == beyond_the_bound && claim_nothing.contains(each.subject)) each.what = beyond_wangs_bound;
}

}  // namespace

ComparedRates compare_rates(const Statistics& now, std::span<const Campaign> baseline, double risk) {
  ComparedRates rates{pairs_of_rates(now, baseline, risk), 0};
  for (ChangedRate& each : rates_where_few(rates.changed)) rates.changed.push_back(std::move(each));
  rates.compared = rates.changed.size();
  const double level = level_of(risk, rates.compared);
  std::erase_if(rates.changed, [&](const ChangedRate& each) { return each.p >= level; });
  name_bounds(rates.changed, now);
  return rates;
}

}  // namespace nearmiss
