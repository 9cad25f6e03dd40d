#include "reports/sections/headline.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "reports/campaign/complexity.hpp"
#include "reports/sections/measures.hpp"
#include "reports/sections/sections.hpp"
#include "reports/sections/verdicts.hpp"
#include "reports/statistics/family.hpp"
#include "reports/statistics/sums.hpp"
#include "reports/text/json.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

/// "a", "a and b", "a, b and c"
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " and " : ", ";
    text += names[i];
  }
  return text;
}

std::string subjects(const std::vector<std::string>& names) {
  return names.size() <= 4 ? listed(names) : fmt::format("{} subjects", names.size());
}

/// Says what is new since the baseline. `asked` is the number of subjects of the campaign.
std::string since_text(const Changes& since, std::size_t asked) {
  if (asked != 0 && since.absent_subjects.size() == asked) return "no subject is in the baseline";
  std::vector<std::string> news;
  const auto add = [&](auto count, std::string_view one, std::string_view many) {
    if (count != 0) news.push_back(counted(static_cast<std::uint64_t>(count), one, many));
  };
  add(since.new_signatures.size(), "new way to fail", "new ways to fail");
  add(std::count_if(since.rates.begin(), since.rates.end(), std::mem_fn(&ChangedRate::worse)), "worse rate",
      "worse rates");
  const auto slower = [&](bool of_subject) {
    return std::count_if(
        since.times.changed.begin(), since.times.changed.end(),
        [&](const ChangedTime& time) { return time.slower() && time.is_of_subject() == of_subject; });
  };
  add(slower(true), "subject slower", "subjects slower");
  add(slower(false), "family slower", "families slower");
  const std::size_t lasting = since.lasting_signatures.size();
  const std::size_t gone = since.gone_signatures.size();
  return (lasting == 0 ? "" : counted(lasting, "way to fail", "ways to fail") + " as before, ") +
         (news.empty() ? "nothing worse" : listed(news)) + " since the baseline" +
         (gone == 0 ? "" : ", and " + counted(gone, "way to fail is gone", "ways to fail are gone"));
}

/// "a and b failed ordinary queries", for subjects that failed in the same class.
std::string group_text(const std::vector<const SubjectVerdict*>& group) {
  std::vector<std::string> names;
  for (const SubjectVerdict* each : group) names.push_back(each->subject);
  const SubjectVerdict& first = *group.front();
  const bool has_class = first.least_exotic != QueryClass::unclassified;
  return fmt::format("{} failed{}", subjects(names),
                     has_class ? fmt::format(" {} queries", name(first.least_exotic)) : "");
}

/// Says which subjects failed, which were asked nothing, and which did not fail. If only one subject failed,
/// the text also says how. If several subjects failed, the text groups them by the least exotic class of
/// queries in which they failed.
std::string who_failed(const std::vector<SubjectVerdict>& verdicts) {
  std::map<QueryClass, std::vector<const SubjectVerdict*>> failed;
  std::map<std::string, std::vector<std::string>> unjudged;  // by how they are unjudged
  std::vector<std::string> clean;
  std::vector<std::string> parts;
  for (const SubjectVerdict& each : verdicts) {
    if (is_beyond_contract(each.subject)) continue;
    if (!each.said.empty() && each.said.begin()->first == FailureKind::unjudged)
      unjudged[each.said.begin()->second].push_back(each.subject);
    else if (each.clean)
      clean.push_back(each.subject);
    else
      failed[each.least_exotic].push_back(&each);
  }
  if (failed.size() == 1 && failed.begin()->second.size() == 1) {
    const SubjectVerdict& only = *failed.begin()->second.front();
    parts.push_back(fmt::format("{} failed: it {}", only.subject, only.first));
  } else {
    for (const auto& [in, group] : failed) parts.push_back(group_text(group));
  }
  for (const auto& [how, names] : unjudged) parts.push_back(fmt::format("{} {}", subjects(names), how));
  if (!clean.empty()) parts.push_back(fmt::format("{} did not fail", subjects(clean)));
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::vector<std::string> alarms_of(const std::vector<SubjectVerdict>& verdicts, const std::string& complaint,
                                   const std::optional<Changes>& since, const Failures& failing) {
  std::vector<std::string> alarms;
  if (!complaint.empty()) alarms.push_back("the oracle: " + complaint);
  for (const SubjectVerdict& each : verdicts)
    for (const auto& [failure, text] : each.said)
      if (breaks_promise(failure) || !since || !since->failed_before.contains({each.subject, failure}))
        alarms.push_back(fmt::format("{} {}", each.subject, text));
  if (since)
    for (std::string& line : lines_for_the_worse(*since, failing)) alarms.push_back(std::move(line));
  return alarms;
}

}  // namespace

Headline headline(const Statistics& statistics, const std::optional<Changes>& since,
                  const Failures& failing) {
  const std::vector<SubjectVerdict> verdicts = subject_verdicts(statistics, failing);
  const std::string complaint = oracle_complaint(statistics);
  std::string text = who_failed(verdicts);
  if (const auto queries = statistics.oracle_total().queries; queries != 0)
    text += fmt::format(", in {}", counted(queries, "query", "queries"));
  if (since) text += fmt::format("{}{}", text.empty() ? "" : "; ", since_text(*since, verdicts.size()));
  if (!complaint.empty())
    text = fmt::format("The oracle cannot be trusted: {}{}{}", complaint, text.empty() ? "" : ". ", text);
  if (text.empty()) text = "No subject was asked";
  auto alarms = alarms_of(verdicts, complaint, since, failing);
  return {!has_failed(statistics, failing) && alarms.empty(), text + ".", std::move(alarms)};
}

using nlohmann::ordered_json;

namespace {

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

/// The index of a subject's simplest finding; null if the subject has no finding. Prefers, in this order,
/// findings whose failure counts, less exotic queries, graver failures, and simpler shrunk queries.
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
