#include "reports/sections/baseline.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "ccd/error.hpp"
#include "corpus/query_text.hpp"
#include "reports/statistics/family.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

using nlohmann::ordered_json;

constexpr std::string_view beyond_the_bound = "false positives beyond the bound";
constexpr std::string_view beyond_wangs_bound = "false positives beyond wang's bound (no claim)";

/// The rates that are compared, for one subject, kind and family.
std::vector<std::pair<std::string_view, Proportion>> rates_of(const Counts& counts) {
  return {{"false negatives", {counts.false_negatives, counts.collisions}},
          {"false positives", {counts.false_positives, counts.others()}},
          {"late times", {counts.late, counts.times_promised}},
          {beyond_the_bound, {counts.distances.at_least_one(), counts.others()}},
          {"no answer", {counts.faults_total(), counts.queries}}};
}

/// All rates that both campaigns have, whether changed or not.
std::vector<ChangedRate> pairs_of_rates(const Statistics& now, const Statistics& before) {
  std::vector<ChangedRate> pairs;
  for (const auto& [key, counts] : now.counts) {
    const auto earlier = before.counts.find(key);
    if (earlier == before.counts.end() || !is_random(key.family)) continue;
    const auto rates = rates_of(counts);
    const auto earlier_rates = rates_of(earlier->second);
    for (std::size_t i = 0; i < rates.size(); ++i)
      if (rates[i].second.total != 0 && earlier_rates[i].second.total != 0)
        pairs.push_back({rates[i].first, key.subject, std::string(short_name(key.kind)), key.family,
                         earlier_rates[i].second, rates[i].second});
  }
  for (ChangedRate& each : pairs) each.p = fisher_test(each.now, each.before).either();
  return pairs;
}

/// A family has few failures up to one of these numbers. All are tried, because larger campaigns have more
/// failures.
constexpr std::array<std::uint64_t, 3> fews{5, 20, 80};

/// A subject and the name of one of its rates.
using RateName = std::pair<std::string, std::string_view>;

/// The pairs that have at least one failure and at most `few` in both campaigns together, by the rate's name.
/// Selecting pairs by this sum favours neither campaign, because each failure counted in the sum is as likely
/// in one campaign as in the other.
std::map<RateName, std::vector<std::pair<Proportion, Proportion>>> pairs_with_few(
    const std::vector<ChangedRate>& pairs, std::uint64_t few) {
  std::map<RateName, std::vector<std::pair<Proportion, Proportion>>> found;
  for (const ChangedRate& each : pairs)
    if (const std::uint64_t both = each.now.count + each.before.count; both != 0 && both <= few)
      found[{each.subject, each.what}].emplace_back(each.now, each.before);
  return found;
}

/// The rates of each subject over all families and kinds with few failures. The function takes the number in
/// `fews` that gives the smallest p, and multiplies this p by the length of `fews`.
std::vector<ChangedRate> rates_where_few(const std::vector<ChangedRate>& pairs) {
  std::map<RateName, ChangedRate> best;
  for (const std::uint64_t few : fews)
    for (const auto& [name, proportions] : pairs_with_few(pairs, few)) {
      if (proportions.size() == 1) continue;  // a single family is compared elsewhere
      ChangedRate sum{name.second, name.first, "vt, ee", fmt::format("families with at most {}", few),
                      {},          {}};
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

/// The values of each fact, over all runs.
std::map<std::string, std::set<std::string>> facts_of(const Campaign& campaign) {
  std::map<std::string, std::set<std::string>> facts;
  for (const Run& run : campaign.runs)
    for (const auto& [name, value] : run.info) facts[name].insert(value);
  facts.erase("again");  // the command repeats the other facts
  return facts;
}

std::vector<ChangedFact> changed_facts(const Campaign& now, const Campaign& baseline) {
  auto facts = facts_of(now);
  auto earlier = facts_of(baseline);
  for (const auto& [name, values] : earlier) facts[name];  // includes facts that only the baseline has
  const auto joined = [](const std::set<std::string>& values) {
    constexpr std::size_t most_shown = 6;
    return values.size() > most_shown ? fmt::format("{} values", values.size())
                                      : fmt::format("{}", fmt::join(values, " | "));
  };
  std::vector<ChangedFact> changed;
  for (const auto& [name, values] : facts)
    if (earlier[name] != values) changed.push_back({name, joined(earlier[name]), joined(values)});
  return changed;
}

std::vector<Signature> only_in(const Campaign& one, const Campaign& other) {
  std::vector<Signature> signatures;
  for (const auto& [signature, times] : one.statistics.seen)
    if (!other.statistics.seen.contains(signature)) signatures.push_back(signature);
  return signatures;
}

/// The number of queries with this signature, among all queries of its subject.
Proportion proportion_of(const Statistics& statistics, const Signature& signature) {
  const std::uint64_t seen = statistics.times_seen(signature);
  return {seen, std::max(seen, statistics.queries_of(signature.subject))};
}

/// The expected number of new signatures in a campaign with `ratio` times as many queries. This number is
/// computed from the number of times that each known signature was seen, with the series of Good and Toulmin
/// 1956, or with its first term for a larger campaign.
double expected_unseen(const std::vector<std::uint64_t>& seen, double ratio) {
  double expected = 0;
  for (const std::uint64_t times : seen) {
    if (ratio > 1)
      expected += times == 1 ? ratio : 0;
    else
      expected -= std::pow(-ratio, static_cast<double>(times));
  }
  return std::max(expected, 0.0);
}

/// The subjects that were asked now, but not in the baseline.
std::vector<std::string> absent_subjects(const Statistics& now, const Statistics& before) {
  std::vector<std::string> absent;
  for (const auto& [key, sum] : now.by_subject_and_kind())
    if ((absent.empty() || absent.back() != key.subject) && now.queries_of(key.subject) != 0 &&
        before.queries_of(key.subject) == 0)
      absent.push_back(key.subject);
  return absent;
}

/// The date of a campaign: the earliest start of a shard; "" if it is not known.
std::string date_of(const Campaign& campaign) {
  std::string date;
  for (const Run& run : campaign.runs)
    for (const Shard& shard : run.shards)
      if (date.empty() || (!shard.started.empty() && shard.started < date)) date = shard.started;
  return date;
}

std::map<Signature, Sightings> sightings_in(std::span<const Campaign> campaigns) {
  std::map<Signature, Sightings> all;
  for (const Campaign& each : campaigns) {
    const std::string date = date_of(each);
    for (const auto& [signature, times] : each.statistics.seen) {
      const auto [place, is_first] = all.try_emplace(signature, Sightings{date, date, 0});
      place->second.last = date;
      ++place->second.campaigns;
    }
  }
  return all;
}

/// Compares signatures with those of the baseline.
void compare_signatures(const Statistics& now, const Statistics& before, Changes& changes) {
  // The numbers of times that signatures were seen before, by sort of failure and subject.
  std::map<std::pair<Finding::What, std::string>, std::vector<std::uint64_t>> seen_before;
  for (const auto& [signature, count] : before.seen)
    seen_before[{signature.what, signature.subject}].push_back(count);
  const std::size_t comparisons = now.seen.size() + changes.gone_signatures.size();
  const double level = false_alarm_risk / static_cast<double>(std::max<std::size_t>(1, comparisons));
  for (const auto& [signature, count] : now.seen) {
    if (std::binary_search(changes.absent_subjects.begin(), changes.absent_subjects.end(), signature.subject))
      continue;
    const bool is_unseen = before.times_seen(signature) == 0;
    const bool fails_anyway =
        !signature.subject.empty() && seen_before.contains({signature.what, signature.subject});
    const bool is_new =
        fails_anyway
            ? fisher_test(proportion_of(now, signature), proportion_of(before, signature)).more < level
            : is_unseen;
    if (is_new)
      changes.new_signatures.push_back(signature);
    else if (is_unseen)
      changes.unseen_signatures.push_back(signature);
    else
      changes.lasting_signatures.push_back(signature);
  }
  for (const auto& [what, seen] : seen_before) {
    const Proportion queries{now.queries_of(what.second), before.queries_of(what.second)};
    if (queries.total != 0) changes.expected_unseen += expected_unseen(seen, queries.rate());
  }
}

ordered_json signatures_json(const std::vector<Signature>& signatures, const Changes& changes) {
  ordered_json json = ordered_json::array();
  for (const Signature& each : signatures) {
    json.push_back({{"what", name(each.what)}, {"subject", each.subject}, {"signature", each.text}});
    if (const auto known = changes.sightings.find(each); known != changes.sightings.end())
      json.back().update({{"first_seen", known->second.first},
                          {"last_seen", known->second.last},
                          {"campaigns", known->second.campaigns}});
  }
  return json;
}

ordered_json rate_json(const Proportion& proportion) {
  const ConfidenceInterval interval = clopper_pearson(proportion.count, proportion.total);
  return {{"count", proportion.count},
          {"total", proportion.total},
          {"rate", proportion.rate()},
          {"interval_95", {interval.lo, interval.hi}}};
}

std::string text_of(const Proportion& rate) {
  return fmt::format("{} of {}", with_separators(rate.count), with_separators(rate.total));
}

std::string text_of(const Signature& signature) {
  return fmt::format("{} of {}, {}", name(signature.what),
                     signature.subject.empty() ? "the oracle" : signature.subject, signature.text);
}

/// "worse: false negatives of mine vt in uniform, 1 of 20 before, 9 of 20 now"
std::string text_of(const ChangedRate& rate) {
  return fmt::format("{}: {} of {} {} in {}, {} before, {} now", rate.worse() ? "worse" : "better", rate.what,
                     rate.subject, rate.kind, rate.family, text_of(rate.before), text_of(rate.now));
}

/// ", first seen 2026-01-02T22:00:00Z, last seen 2026-01-09T22:00:00Z"; "" if the baseline does not have it.
std::string sightings_text(const Changes& changes, const Signature& signature) {
  const auto known = changes.sightings.find(signature);
  if (known == changes.sightings.end() || known->second.first.empty()) return "";
  return fmt::format(", first seen {}, last seen {}", known->second.first, known->second.last);
}

/// Names the bound of subjects that claim none.
void name_bounds(std::vector<ChangedRate>& rates, const Statistics& now) {
  std::set<std::string> claim_nothing;
  for (const auto& [key, counts] : now.counts)
    if (counts.distance_unit() != DistanceUnit::claimed_bound) claim_nothing.insert(key.subject);
  for (ChangedRate& each : rates)
    if (each.what == beyond_the_bound && claim_nothing.contains(each.subject)) each.what = beyond_wangs_bound;
}

}  // namespace

Campaign add_up(std::span<const Campaign> campaigns) {
  Campaign sum;
  std::set<std::pair<RunInfo, std::uint64_t>> random;
  for (const Campaign& each : campaigns) {
    sum.statistics.merge(each.statistics);
    for (const Run& run : each.runs) {
      for (const Shard& shard : run.shards)
        if (run.info.contains("seed") && !random.emplace(run.info, shard.index).second)
          throw Error(fmt::format("the baseline has shard {}/{} of the run with seed {} twice", shard.index,
                                  shard.count, run.info.at("seed")));
      sum.runs.push_back(run);
    }
  }
  return sum;
}

Changes changes(const Campaign& now, const Campaign& baseline) { return changes(now, {&baseline, 1}); }

Changes changes(const Campaign& now, std::span<const Campaign> campaigns) {
  const Campaign baseline = add_up(campaigns);
  Changes changes{.new_signatures = {},
                  .unseen_signatures = {},
                  .gone_signatures = only_in(baseline, now),
                  .lasting_signatures = {},
                  .sightings = sightings_in(campaigns),
                  .absent_subjects = absent_subjects(now.statistics, baseline.statistics),
                  .rates = pairs_of_rates(now.statistics, baseline.statistics),
                  .compared_rates = 0,
                  .facts = changed_facts(now, baseline)};
  for (const auto& [subject, failures] : failures_by_subject(baseline.statistics))
    for (const FailureKind each : failures) changes.failed_before.emplace(subject, each);
  compare_signatures(now.statistics, baseline.statistics, changes);
  for (ChangedRate& each : rates_where_few(changes.rates)) changes.rates.push_back(std::move(each));
  changes.compared_rates = changes.rates.size();
  const double level = false_alarm_risk / static_cast<double>(std::max<std::size_t>(1, changes.rates.size()));
  std::erase_if(changes.rates, [&](const ChangedRate& each) { return each.p >= level; });
  name_bounds(changes.rates, now.statistics);
  return changes;
}

std::vector<std::string> lines_for_the_worse(const Changes& changes, const Failures& failing) {
  std::vector<std::string> lines;
  for (const Signature& each : changes.new_signatures)
    if (failing.contains(failure_of(each)))
      lines.push_back(fmt::format("new: {}{}", text_of(each), sightings_text(changes, each)));
  for (const ChangedRate& each : changes.rates)
    if (each.worse()) lines.push_back(text_of(each));
  return lines;
}

std::string describe(const Changes& changes) {
  std::string text;
  for (const Signature& each : changes.new_signatures)
    text += fmt::format("new: {}{}\n", text_of(each), sightings_text(changes, each));
  for (const Signature& each : changes.lasting_signatures)
    text += fmt::format("lasting: {}{}\n", text_of(each), sightings_text(changes, each));
  for (const std::string& each : changes.absent_subjects)
    text += fmt::format("not in the baseline: {}\n", each);
  for (const ChangedRate& each : changes.rates) text += text_of(each) + "\n";
  return text;
}

ordered_json changes_json(const Changes& changes) {
  ordered_json json;
  json["new_signatures"] = signatures_json(changes.new_signatures, changes);
  json["unseen_signatures"] = signatures_json(changes.unseen_signatures, changes);
  json["expected_unseen"] = changes.expected_unseen;
  json["gone_signatures"] = signatures_json(changes.gone_signatures, changes);
  json["lasting_signatures"] = signatures_json(changes.lasting_signatures, changes);
  json["absent_subjects"] = changes.absent_subjects;
  json["level"] = false_alarm_risk;
  json["compared_rates"] = changes.compared_rates;
  json["changed_rates"] = ordered_json::array();
  for (const ChangedRate& each : changes.rates)
    json["changed_rates"].push_back({{"what", each.what},
                                     {"subject", each.subject},
                                     {"kind", each.kind},
                                     {"family", each.family},
                                     {"worse", each.worse()},
                                     {"p", each.p},
                                     {"before", rate_json(each.before)},
                                     {"now", rate_json(each.now)}});
  json["changed_facts"] = ordered_json::array();
  for (const ChangedFact& each : changes.facts)
    json["changed_facts"].push_back({{"name", each.name}, {"before", each.before}, {"now", each.now}});
  return json;
}

}  // namespace nearmiss
