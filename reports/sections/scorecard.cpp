#include "reports/sections/scorecard.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>

#include "reports/campaign/complexity.hpp"
#include "reports/sections/counts_json.hpp"
#include "reports/sections/ladder.hpp"
#include "reports/sections/verdicts.hpp"
#include "reports/statistics/family_class.hpp"

namespace nearmiss {

using nlohmann::ordered_json;

namespace {

/// A subject's counters over both kinds.
struct OfSubject {
  CountsSum all;
  std::map<QueryClass, CountsSum> by_class;
};

std::map<std::string, OfSubject> by_subject(const Statistics& statistics) {
  std::map<std::string, OfSubject> subjects;
  for (const auto& [key, counts] : statistics.counts) {
    OfSubject& subject = subjects[key.subject];
    subject.all.add(key.family, counts);
    subject.by_class[class_of(key.family)].add(key.family, counts);
  }
  return subjects;
}

/// The number of a subject's ways to fail, and of its rates that are worse.
ordered_json changes_of(const std::string& subject, const Changes& since) {
  const auto of_subject = [&](const auto& each) { return each.subject == subject; };
  const auto number = [&](const std::vector<Signature>& signatures) {
    return std::count_if(signatures.begin(), signatures.end(), of_subject);
  };
  return {
      {"new", number(since.new_signatures)},
      {"lasting", number(since.lasting_signatures)},
      {"gone", number(since.gone_signatures)},
      {"worse", std::count_if(since.rates.begin(), since.rates.end(),
                              [&](const ChangedRate& each) { return of_subject(each) && each.worse(); })},
      {"better", std::count_if(since.rates.begin(), since.rates.end(),
                               [&](const ChangedRate& each) { return of_subject(each) && !each.worse(); })},
      {"absent", std::find(since.absent_subjects.begin(), since.absent_subjects.end(), subject) !=
                     since.absent_subjects.end()}};
}

/// The number of queries without an answer, by reason.
ordered_json faults_of(const Counts& counts) {
  ordered_json json = ordered_json::object();
  for (std::size_t i = 1; i < fault_count; ++i)
    if (counts.faults[i] != 0) json[std::string(fault_names[i])] = counts.faults[i];
  return json;
}

ordered_json names_of(const Failures& failures) {
  ordered_json json = ordered_json::array();
  for (const FailureKind each : failures) json.push_back(name(each));
  return json;
}

/// The index of the simplest failure: of the least exotic query, a miss if there is one, else a late time.
ordered_json index_of_simplest(const std::string& subject, const std::vector<ShownFinding>& findings) {
  const auto rank = [](const Finding& finding) {
    return std::tuple(exoticness(finding.shrunk, finding.query_class),
                      finding.what != Finding::What::false_negative, finding.what != Finding::What::late,
                      complexity(finding.shrunk));
  };
  std::optional<std::size_t> simplest;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    if (findings[i].finding.subject != subject) continue;
    if (!simplest || rank(findings[i].finding) < rank(findings[*simplest].finding)) simplest = i;
  }
  return simplest ? ordered_json(*simplest) : ordered_json();
}

}  // namespace

ordered_json scorecard_json(const Statistics& statistics, const std::vector<ShownFinding>& findings,
                            const std::optional<Changes>& since, const Failures& failing) {
  const auto subjects = by_subject(statistics);
  ordered_json json = ordered_json::array();
  for (const SubjectVerdict& each : subject_verdicts(statistics, failing)) {
    const LadderPlace place = place_of(each.subject);
    const auto& [all, by_class] = subjects.at(each.subject);
    ordered_json row{{"subject", each.subject},
                     {"clean", each.clean},
                     {"failures", names_of(each.failures)},
                     {"text", each.text},
                     {"algorithm", place.algorithm},
                     {"scalar", place.scalar},
                     {"epsilon", std::exp2(place.epsilon_exponent)},
                     {"counts", rates_json(all.counts, all.is_sample)},
                     {"faults", faults_of(all.counts)},
                     {"times",
                      {{"median_ns", or_null(all.counts.times.each.quantile(0.5))},
                       {"q99_ns", or_null(all.counts.times.each.quantile(0.99))}}},
                     {"classes", ordered_json::object()},
                     {"finding", index_of_simplest(each.subject, findings)}};
    for (const auto& [of, sum] : by_class)
      row["classes"][std::string(name(of))] = rates_json(sum.counts, sum.is_sample);
    if (since) row["since"] = changes_of(each.subject, *since);
    json.push_back(std::move(row));
  }
  return json;
}

}  // namespace nearmiss
