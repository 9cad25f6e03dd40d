#include "reports/sections/headline.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>

#include "reports/campaign/complexity.hpp"
#include "reports/sections/counts_json.hpp"
#include "reports/sections/ladder.hpp"
#include "reports/sections/verdicts.hpp"
#include "reports/statistics/family.hpp"
#include "reports/statistics/sums.hpp"
#include "reports/text/json.hpp"

namespace nearmiss {

using nlohmann::ordered_json;

namespace {

/// How many of a subject's ways to fail, rates and run times have changed.
ordered_json changes_of(const std::string& subject, const Changes& since) {
  const auto of_subject = [&](const auto& each) { return each.subject == subject; };
  const auto number = [&](const std::vector<Signature>& signatures) {
    return std::count_if(signatures.begin(), signatures.end(), of_subject);
  };
  const auto times = [&](bool slower) {
    return std::count_if(
        since.times.changed.begin(), since.times.changed.end(),
        [&](const ChangedTime& each) { return of_subject(each) && each.slower() == slower; });
  };
  return {
      {"new", number(since.new_signatures)},
      {"lasting", number(since.lasting_signatures)},
      {"gone", number(since.gone_signatures)},
      {"worse", std::count_if(since.rates.begin(), since.rates.end(),
                              [&](const ChangedRate& each) { return of_subject(each) && each.worse(); })},
      {"better", std::count_if(since.rates.begin(), since.rates.end(),
                               [&](const ChangedRate& each) { return of_subject(each) && !each.worse(); })},
      {"slower", times(true)},
      {"faster", times(false)},
      {"absent", std::find(since.absent_subjects.begin(), since.absent_subjects.end(), subject) !=
                     since.absent_subjects.end()}};
}

ordered_json names_of(const Failures& failures) {
  ordered_json json = ordered_json::array();
  for (const FailureKind each : failures) json.push_back(name(each));
  return json;
}

/// The index of a subject's failure with the least exotic query; if several are equally exotic, the index of
/// the gravest failure. A failure that counts comes before any that does not.
ordered_json index_of_simplest(const std::string& subject, const std::vector<ShownFinding>& findings,
                               const Failures& failing) {
  const auto rank = [&](const Finding& finding) {
    const FailureKind failure = failure_of(signature_of(finding));
    return std::tuple(!failing.contains(failure), least_exotic_first(finding), failure,
                      complexity(finding.shrunk));
  };
  std::optional<std::size_t> simplest;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const Finding& finding = findings[i].finding;
    if (finding.subject != subject) continue;
    if (!simplest || rank(finding) < rank(findings[*simplest].finding)) simplest = i;
  }
  return simplest ? ordered_json(*simplest) : ordered_json();
}

}  // namespace

ordered_json scorecard_json(const Statistics& statistics, const std::vector<ShownFinding>& findings,
                            const std::optional<Changes>& since, const Failures& failing) {
  const auto by_subject = sums_by(statistics, &CountsKey::subject);
  const auto by_class =
      sums_by(statistics, [](const CountsKey& key) { return std::pair(key.subject, class_of(key.family)); });
  ordered_json json = ordered_json::array();
  for (const SubjectVerdict& each : subject_verdicts(statistics, failing)) {
    const CountsSum& all = by_subject.at(each.subject);
    ordered_json row{{"subject", each.subject},
                     {"clean", each.clean},
                     {"beyond_contract", is_beyond_contract(each.subject)},
                     {"failures", names_of(each.failures)},
                     {"text", each.text}};
    row.update(place_json(place_of(each.subject)));
    row["counts"] = rates_json(all);
    row["faults"] = counts_json(all).at("faults");
    add_measures(row["times"], {"median_ns", "q99_ns"}, all);
    row["classes"] = ordered_json::object();
    for (auto of = by_class.lower_bound({each.subject, QueryClass()});
         of != by_class.end() && of->first.first == each.subject; ++of)
      row["classes"][std::string(name(of->first.second))] = rates_json(of->second);
    row["finding"] = each.clean && !is_beyond_contract(each.subject)
                         ? ordered_json()
                         : index_of_simplest(each.subject, findings, failing);
    if (since) row["since"] = changes_of(each.subject, *since);
    json.push_back(std::move(row));
  }
  return json;
}

}  // namespace nearmiss
