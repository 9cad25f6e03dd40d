#include "reports/baseline.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "corpus/query_text.hpp"
#include "reports/text.hpp"

namespace nearmiss {

namespace {

using nlohmann::ordered_json;

bool is_random(const std::string& family) { return !family.ends_with('/') && !family.starts_with("scene:"); }

/// The rates of one counter that are compared, intervals not yet told.
std::vector<std::pair<std::string_view, Rate>> rates_of(const Counts& counts) {
  return {{"false negatives", {counts.false_negatives, counts.collisions, {}}},
          {"false positives", {counts.false_positives, counts.queries - counts.collisions, {}}},
          {"no answer", {counts.faults_total(), counts.queries, {}}}};
}

/// All rates that both campaigns have, changed or not.
std::vector<ChangedRate> pairs_of_rates(const Statistics& now, const Statistics& before) {
  std::vector<ChangedRate> pairs;
  for (const auto& [key, counts] : now.counts) {
    const auto earlier = before.counts.find(key);
    if (earlier == before.counts.end() || !is_random(key.family)) continue;
    const auto rates = rates_of(counts);
    const auto earlier_rates = rates_of(earlier->second);
    for (std::size_t i = 0; i < rates.size(); ++i)
      if (rates[i].second.total != 0 && earlier_rates[i].second.total != 0)
        pairs.push_back({rates[i].first, key, earlier_rates[i].second, rates[i].second});
  }
  return pairs;
}

/// The values of each fact, over all runs.
std::map<std::string, std::set<std::string>> facts_of(const Campaign& campaign) {
  std::map<std::string, std::set<std::string>> facts;
  for (const Run& run : campaign.runs)
    for (const auto& [name, value] : run.info) facts[name].insert(value);
  facts.erase("again");  // says the same once more
  return facts;
}

std::vector<ChangedFact> changed_facts(const Campaign& now, const Campaign& baseline) {
  auto facts = facts_of(now);
  auto earlier = facts_of(baseline);
  for (const auto& [name, values] : earlier) facts[name];  // a fact that is gone too
  std::vector<ChangedFact> changed;
  for (const auto& [name, values] : facts)
    if (earlier[name] != values)
      changed.push_back({name, fmt::format("{}", fmt::join(earlier[name], " | ")),
                         fmt::format("{}", fmt::join(values, " | "))});
  return changed;
}

std::vector<Signature> only_in(const Campaign& one, const Campaign& other) {
  std::vector<Signature> signatures;
  for (const auto& [signature, times] : one.statistics.seen)
    if (!other.statistics.seen.contains(signature)) signatures.push_back(signature);
  return signatures;
}

ordered_json signatures_json(const std::vector<Signature>& signatures) {
  ordered_json json = ordered_json::array();
  for (const Signature& each : signatures)
    json.push_back({{"what", name(each.what)}, {"subject", each.subject}, {"signature", each.text}});
  return json;
}

ordered_json rate_json(const Rate& rate) {
  return {{"count", rate.count},
          {"total", rate.total},
          {"rate", static_cast<double>(rate.count) / static_cast<double>(rate.total)},
          {"interval", {rate.interval.lo, rate.interval.hi}}};
}

std::string text_of(const Rate& rate) {
  return fmt::format("{} of {}", with_separators(rate.count), with_separators(rate.total));
}

std::string text_of(const Signature& signature) {
  return fmt::format("{} of {}, {}", name(signature.what),
                     signature.subject.empty() ? "the oracle" : signature.subject, signature.text);
}

}  // namespace

bool Changes::for_the_worse() const {
  return !new_signatures.empty() || std::any_of(rates.begin(), rates.end(), std::mem_fn(&ChangedRate::worse));
}

Changes changes(const Campaign& now, const Campaign& baseline) {
  Changes changes{.new_signatures = only_in(now, baseline),
                  .gone_signatures = only_in(baseline, now),
                  .rates = pairs_of_rates(now.statistics, baseline.statistics),
                  .compared_rates = 0,
                  .facts = changed_facts(now, baseline)};
  changes.compared_rates = changes.rates.size();
  // Where nothing has changed two intervals are disjoint only if one of them misses the true rate.
  const double risk =
      false_alarm_risk / (2 * static_cast<double>(std::max<std::size_t>(1, changes.rates.size())));
  for (ChangedRate& each : changes.rates)
    for (Rate* rate : {&each.before, &each.now})
      rate->interval = clopper_pearson(rate->count, rate->total, risk);
  std::erase_if(changes.rates, [](const ChangedRate& each) {
    return each.before.interval.lo <= each.now.interval.hi && each.now.interval.lo <= each.before.interval.hi;
  });
  return changes;
}

std::string describe(const Changes& changes) {
  std::string text;
  for (const Signature& each : changes.new_signatures) text += fmt::format("new: {}\n", text_of(each));
  for (const ChangedRate& each : changes.rates)
    text += fmt::format("{}: {} of {} {} in {}, {} before, {} now\n", each.worse() ? "worse" : "better",
                        each.what, each.key.subject, short_name(each.key.kind), each.key.family,
                        text_of(each.before), text_of(each.now));
  return text;
}

ordered_json changes_json(const Changes& changes) {
  ordered_json json;
  json["new_signatures"] = signatures_json(changes.new_signatures);
  json["gone_signatures"] = signatures_json(changes.gone_signatures);
  json["compared_rates"] = changes.compared_rates;
  json["changed_rates"] = ordered_json::array();
  for (const ChangedRate& each : changes.rates)
    json["changed_rates"].push_back({{"what", each.what},
                                     {"subject", each.key.subject},
                                     {"kind", short_name(each.key.kind)},
                                     {"family", each.key.family},
                                     {"worse", each.worse()},
                                     {"before", rate_json(each.before)},
                                     {"now", rate_json(each.now)}});
  json["changed_facts"] = ordered_json::array();
  for (const ChangedFact& each : changes.facts)
    json["changed_facts"].push_back({{"name", each.name}, {"before", each.before}, {"now", each.now}});
  return json;
}

}  // namespace nearmiss
