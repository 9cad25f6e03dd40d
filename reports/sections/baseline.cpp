#include "reports/sections/baseline.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "ccd/query/error.hpp"
#include "reports/text/json.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

using nlohmann::ordered_json;

std::map<std::string, std::set<std::string>> facts_of(const Campaign& campaign) {
  std::map<std::string, std::set<std::string>> facts;
  for (const Run& run : campaign.runs)
    for (const auto& [name, value] : run.info) facts[name].insert(value);
  // the values of the fact "again" are commands, which say no more than the other facts
  facts.erase("again");
  return facts;
}

std::vector<ChangedFact> changed_facts(const Campaign& now, const Campaign& baseline) {
  auto facts = facts_of(now);
  auto earlier = facts_of(baseline);
  // adds the names of the facts that only the baseline has
  for (const auto& [name, values] : earlier) facts[name];
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

ordered_json signatures_json(const std::vector<Signature>& signatures, const Changes& changes) {
  ordered_json json = ordered_json::array();
  for (const Signature& each : signatures) {
    json.push_back({{"what", name(each.what)}, {"subject", each.subject}, {"signature", each.text}});
    if (const auto known = changes.sightings.find(each); known != changes.sightings.end())
      json.back().update({{"first_seen", known->second.first},
                          {"first_code", known->second.first_code.text()},
                          {"last_seen", known->second.last},
                          {"last_code", known->second.last_code.text()},
                          {"campaigns", known->second.campaigns}});
    if (const auto fixed = changes.fixed.find(each); fixed != changes.fixed.end())
      json.back()["fixed"] = fixed->second;
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

/// "false negatives of mine vt in uniform, 1 of 20 before, 9 of 20 now"
std::string text_of(const ChangedRate& rate) {
  return fmt::format("{} of {} {} in {}, {} before, {} now", rate.what, rate.subject, rate.kind, rate.family,
                     text_of(rate.before), text_of(rate.now));
}

/// "2026-01-02T22:00:00Z (version 1)"
std::string sighting_text(const std::string& date, const SubjectCode& code) {
  return code.text().empty() ? date : fmt::format("{} ({})", date, code.text());
}

/// ", first seen 2026-01-02T22:00:00Z (version 1), last seen 2026-01-09T22:00:00Z (version 2)"; "" if the
/// baseline does not have the signature.
std::string sightings_text(const Changes& changes, const Signature& signature) {
  const auto known = changes.sightings.find(signature);
  if (known == changes.sightings.end() || known->second.first.empty()) return "";
  const Sightings& seen = known->second;
  return fmt::format(", first seen {}, last seen {}", sighting_text(seen.first, seen.first_code),
                     sighting_text(seen.last, seen.last_code));
}

/// "mine vt in uniform, 1.52 times: 472 ns a query, 310 expected"
std::string text_of(const ChangedTime& time) {
  return fmt::format("{} {} in {}, {:.2f} times: {:.3g} ns a query, {:.3g} expected", time.subject, time.kind,
                     time.family, time.ratio(), time.now, time.expected);
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
  Campaign baseline = add_up(campaigns);
  ComparedRates rates = compare_rates(now.statistics, campaigns, false_alarm_risk);
  Changes changes{compare_signatures(now, campaigns, baseline.statistics, false_alarm_risk),
                  std::move(rates.changed), rates.compared, compare_times(now, campaigns, false_alarm_risk),
                  changed_facts(now, baseline)};
  for (const auto& [subject, failures] : failures_by_subject(baseline.statistics))
    for (const FailureKind each : failures) changes.failed_before.emplace(subject, each);
  changes.baseline = std::move(baseline);
  return changes;
}

std::vector<std::string> lines_for_the_worse(const Changes& changes, const Failures& failing) {
  std::vector<std::string> lines;
  for (const Signature& each : changes.new_signatures)
    if (failing.contains(failure_of(each)))
      lines.push_back(fmt::format("new: {}{}", text_of(each), sightings_text(changes, each)));
  for (const ChangedRate& each : changes.rates)
    if (each.worse()) lines.push_back("worse: " + text_of(each));
  return lines;
}

namespace {

/// A line of `describe`: a title, such as "worse", and a text.
struct Line {
  std::string title, subject;
  const char* many;  ///< the plural noun for the changes in lines with this title, such as "rates"
  std::string text;
};

/// A line for each subject: "3 ways to fail of mine, the oldest first seen 2026-01-02T22:00:00Z (version 1)".
std::vector<Line> lasting_by_subject(const Changes& changes) {
  std::map<std::string, std::vector<Sightings>> of_subject;
  for (const Signature& each : changes.lasting_signatures)
    of_subject[each.subject].push_back(changes.sightings.at(each));
  std::vector<Line> lines;
  for (const auto& [subject, seen] : of_subject) {
    const Sightings& oldest = *std::ranges::min_element(seen, {}, &Sightings::first);
    const std::string since =
        oldest.first.empty() ? ""
                             : ", the oldest first seen " + sighting_text(oldest.first, oldest.first_code);
    lines.push_back({"lasting", subject, "",
                     fmt::format("{} of {}{}", counted(seen.size(), "way to fail", "ways to fail"),
                                 subject.empty() ? "the oracle" : subject, since)});
  }
  return lines;
}

std::vector<Line> lines_of(const Changes& changes, bool verbose) {
  std::vector<Line> lines;
  const auto list = [&](const char* title, const std::vector<Signature>& signatures) {
    for (const Signature& each : signatures) {
      const auto fixed = changes.fixed.find(each);
      lines.push_back({fixed == changes.fixed.end() ? title : "fixed " + fixed->second, each.subject,
                       "ways to fail", text_of(each) + sightings_text(changes, each)});
    }
  };
  list("new", changes.new_signatures);
  if (verbose)
    list("lasting", changes.lasting_signatures);
  else
    std::ranges::move(lasting_by_subject(changes), std::back_inserter(lines));
  list("gone", changes.gone_signatures);
  for (const std::string& each : changes.absent_subjects)
    lines.push_back({"not in the baseline", each, "", each});
  for (const ChangedRate& each : changes.rates)
    lines.push_back({each.worse() ? "worse" : "better", each.subject, "rates", text_of(each)});
  for (const ChangedTime& each : changes.times.changed)
    lines.push_back({each.slower() ? "slower" : "faster", each.subject, "run times", text_of(each)});
  return lines;
}

}  // namespace

std::string describe(const Changes& changes, bool verbose) {
  const std::vector<Line> lines = lines_of(changes, verbose);
  std::map<std::pair<std::string, std::string>, std::size_t> counts;
  for (const Line& each : lines) ++counts[{each.title, each.subject}];
  std::string text;
  for (const Line& each : lines) {
    std::size_t& count = counts.at({each.title, each.subject});
    if (verbose || count == 1)
      text += fmt::format("{}: {}\n", each.title, each.text);
    else if (count > 1)  // the first of several lines with the same title and subject stands for all of them
      text += fmt::format("{}: {} {} of {}, such as {}\n", each.title, with_separators(count), each.many,
                          each.subject.empty() ? "the oracle" : each.subject, each.text);
    if (!verbose) count = 0;
  }
  return text;
}

ordered_json changes_json(const Changes& changes) {
  ordered_json json;
  json["new_signatures"] = signatures_json(changes.new_signatures, changes);
  json["unseen_signatures"] = signatures_json(changes.unseen_signatures, changes);
  json["expected_unseen"] = changes.expected_unseen;
  json["gone_signatures"] = signatures_json(changes.gone_signatures, changes);
  json["unrepeated_signatures"] = signatures_json(changes.unrepeated_signatures, changes);
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
  json["compared_times"] = changes.times.compared;
  json["campaigns_with_times"] = changes.times.campaigns;
  json["changed_times"] = ordered_json::array();
  for (const ChangedTime& each : changes.times.changed)
    json["changed_times"].push_back({{"subject", each.subject},
                                     {"kind", each.kind},
                                     {"family", each.family},
                                     {"slower", each.slower()},
                                     {"ratio", each.ratio()},
                                     {"p", each.p},
                                     {"before_ns", each.before},
                                     {"expected_ns", each.expected},
                                     {"now_ns", each.now}});
  json["changed_facts"] = ordered_json::array();
  for (const ChangedFact& each : changes.facts)
    json["changed_facts"].push_back({{"name", each.name}, {"before", each.before}, {"now", each.now}});
  return json;
}

}  // namespace nearmiss
