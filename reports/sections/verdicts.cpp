#include "reports/sections/verdicts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "reports/statistics/family.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

using Parts = std::map<QueryClass, std::map<Kind, Counts>>;

struct OfSubject {
  Counts all;
  Parts parts;
};

std::map<std::string, OfSubject> by_subject(const Statistics& statistics) {
  std::map<std::string, OfSubject> subjects;
  for (const auto& [key, sum] : by_class(statistics)) {
    subjects[key.subject].all.merge(sum.counts);
    subjects[key.subject].parts[key.of][key.kind] = sum.counts;
  }
  return subjects;
}

std::string of(std::uint64_t count, std::uint64_t total) {
  return fmt::format("{} of {}", with_separators(count), with_separators(total));
}

/// How often a failure happened in the families of one class, and how often it could have happened there.
std::pair<std::uint64_t, std::uint64_t> count_and_total(const std::map<Kind, Counts>& by_kind,
                                                        const FailureInfo& failure) {
  std::uint64_t count = 0;
  std::uint64_t total = 0;
  for (const auto& [kind, counts] : by_kind) {
    count += failure.count(counts);
    total += failure.total(counts);
  }
  return {count, total};
}

/// "ordinary vt 53 of 504, ee 2 of 701; degenerate 1,204 of 5,001": how often a failure happened, for each
/// class of families and, in the first of these classes, for each kind. Leaves out classes and kinds without
/// the failure. Also leaves out the name of the class if only unclassified families have the failure. If
/// queries of ordinary families could have failed, but none of them did, "; no ordinary one of 504" follows.
std::string class_by_class(const Parts& parts, const FailureInfo& failure) {
  std::vector<std::string> classes;
  std::string no_ordinary_one;
  for (const auto& [in, by_kind] : parts) {
    const auto [count, total] = count_and_total(by_kind, failure);
    if (count == 0) {
      if (in == QueryClass::ordinary && total > 0)
        no_ordinary_one = "; no ordinary one of " + with_separators(total);
      continue;
    }
    const bool is_first = classes.empty();
    std::vector<std::string> of_kinds;
    for (const auto& [kind, counts] : by_kind)
      if (failure.count(counts) > 0)
        of_kinds.push_back(
            fmt::format("{} {}", short_name(kind), of(failure.count(counts), failure.total(counts))));
    const std::string text = is_first ? fmt::format("{}", fmt::join(of_kinds, ", ")) : of(count, total);
    const bool is_nameless = is_first && in == QueryClass::unclassified;
    classes.push_back(is_nameless ? text : fmt::format("{} {}", name(in), text));
  }
  return fmt::format("{}{}", fmt::join(classes, "; "), no_ordinary_one);
}

/// "2 of 504 in ordinary families, 40 of 5,000 in extreme families": how often a failure happened, for each
/// class of families.
std::string by_families(const Parts& parts, const FailureInfo& failure) {
  std::vector<std::string> classes;
  for (const auto& [in, by_kind] : parts)
    if (const auto [count, total] = count_and_total(by_kind, failure); count > 0)
      classes.push_back(of(count, total) +
                        (in == QueryClass::unclassified ? "" : fmt::format(" in {} families", name(in))));
  return fmt::format("{}", fmt::join(classes, ", "));
}

/// The least exotic class of families in which a failure happened.
Parts::const_iterator least_exotic_part(const Parts& parts, const FailureInfo& failure) {
  const auto has_failed = [&](const auto& of_kind) { return failure.count(of_kind.second) > 0; };
  return std::find_if(parts.begin(), parts.end(), [&](const auto& part) {
    return std::any_of(part.second.begin(), part.second.end(), has_failed);
  });
}

/// How often a failure happened on queries of a class; 0 if such failures are not counted by class.
std::uint64_t count_of(const Counts& counts, const FailureInfo& failure, QueryClass of) {
  return failure.by_class == nullptr ? 0 : (counts.*failure.by_class)[static_cast<std::size_t>(of)];
}

/// The least exotic class of the queries on which a failure happened; nothing if their classes are not known.
std::optional<QueryClass> class_of_queries(const OfSubject& subject, const FailureInfo& failure) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(QueryClass::unclassified); ++i)
    if (const auto of = static_cast<QueryClass>(i); count_of(subject.all, failure, of) > 0) return of;
  return std::nullopt;
}

/// "ordinary vt", or only the kind if the class is unknown.
std::string class_and_kind(QueryClass of, Kind kind) {
  return of == QueryClass::unclassified ? std::string(short_name(kind))
                                        : fmt::format("{} {}", name(of), short_name(kind));
}

/// "53 of 504 ordinary vt collisions": how often a failure happened in families of the class `in`, for each
/// kind. If `known` is true, the classes of the failed queries are known, and the text leaves out kinds
/// without a failed query of the class `in`. Adds the kinds in the text to `said`. Returns "" if the text
/// would have no kind.
std::string said_of_families(const Parts& parts, const FailureInfo& failure, QueryClass in, bool known,
                             std::set<Kind>& said) {
  const auto part = parts.find(in);
  if (part == parts.end()) return "";
  std::vector<std::string> of_kinds;
  std::uint64_t total = 0;
  for (const auto& [kind, counts] : part->second) {
    if (known ? count_of(counts, failure, in) == 0 : failure.count(counts) == 0) continue;
    said.insert(kind);
    total = failure.total(counts);
    of_kinds.push_back(fmt::format("{} of {} {}", with_separators(failure.count(counts)),
                                   with_separators(total), class_and_kind(in, kind)));
  }
  if (of_kinds.empty()) return "";
  const bool is_one = of_kinds.size() == 1 && total == 1;
  return fmt::format("{} {}", fmt::join(of_kinds, " and "), is_one ? failure.one : failure.many);
}

/// "12 ordinary vt collisions in degenerate families": on how many queries of the class `of` a failure
/// happened, for each kind that is not in `said`. "" if there are no such queries.
std::string said_of_queries(const Parts& parts, const FailureInfo& failure, QueryClass of,
                            const std::set<Kind>& said) {
  std::map<Kind, std::uint64_t> by_kind;
  std::set<QueryClass> families;
  for (const auto& [in, kinds] : parts)
    for (const auto& [kind, counts] : kinds)
      if (const auto count = count_of(counts, failure, of); count > 0 && !said.contains(kind)) {
        by_kind[kind] += count;
        families.insert(in);
      }
  if (by_kind.empty()) return "";
  families.erase(QueryClass::unclassified);
  std::vector<std::string> of_kinds;
  for (const auto& [kind, count] : by_kind)
    of_kinds.push_back(fmt::format("{} {}", with_separators(count), class_and_kind(of, kind)));
  std::vector<std::string_view> names;
  for (const QueryClass each : families) names.push_back(name(each));
  const bool is_one = by_kind.size() == 1 && by_kind.begin()->second == 1;
  return fmt::format("{} {}{}", fmt::join(of_kinds, " and "), is_one ? failure.one : failure.many,
                     names.empty() ? "" : fmt::format(" in {} families", fmt::join(names, " and ")));
}

/// The least exotic class of the queries on which a failure happened, and a text that says how often the
/// failure happened on queries of this class: "missed 53 of 504 ordinary vt collisions, and 12 ordinary ee
/// collisions in degenerate families". If the classes of the queries are not known, uses the classes of their
/// families.
std::pair<QueryClass, std::string> said_of(const OfSubject& subject, const FailureInfo& failure) {
  const auto of_queries = class_of_queries(subject, failure);
  const QueryClass of = of_queries.value_or(least_exotic_part(subject.parts, failure)->first);
  std::set<Kind> said;
  const std::string in_families = said_of_families(subject.parts, failure, of, of_queries.has_value(), said);
  const std::string elsewhere = said_of_queries(subject.parts, failure, of, said);
  const bool both = !in_families.empty() && !elsewhere.empty();
  return {of, fmt::format("{} {}{}{}", failure.verb, in_families, both ? ", and " : "", elsewhere)};
}

/// Whether the subject has been asked a query and was not too slow for it.
bool has_answered(const Counts& counts) {
  const auto unanswered = [&](FailureKind kind) { return failure_info(kind).count(counts); };
  return counts.queries > unanswered(FailureKind::slow) + unanswered(FailureKind::contract);
}

/// Returns the verb and the object of a sentence about one or more unjudged subjects.
std::string_view unjudged_words(const Counts& counts) {
  if (has_answered(counts)) return "left most queries unanswered";
  return failure_info(FailureKind::slow).count(counts) > 0 ? "answered no query in time" : "got no query";
}

/// For each failure that counts, says in words how the subject failed, in the least exotic class with this
/// failure.
void say_failures(const OfSubject& subject, const Failures& failing, SubjectVerdict& verdict) {
  for (const FailureKind kind : in_common(verdict.failures, failing)) {
    verdict.clean = false;
    const FailureInfo& failure = failure_info(kind);
    if (kind == FailureKind::unjudged) {
      verdict.said[kind] = unjudged_words(subject.all);
      if (verdict.first.empty()) verdict.first = verdict.said[kind];
      continue;
    }
    if (least_exotic_part(subject.parts, failure) == subject.parts.end()) continue;
    const auto [of, text] = said_of(subject, failure);
    verdict.said[kind] = text;
    if (!verdict.first.empty() && of >= verdict.least_exotic) continue;
    verdict.first = text;
    verdict.least_exotic = of;
  }
}

/// "NO ANSWER (2 crash, 1 exception)"
std::string no_answer(const Counts& counts) {
  std::vector<std::string> reasons;
  for (std::size_t i = 0; i < fault_count; ++i) {
    const auto fault = static_cast<Fault>(i);
    if (counts.faults[i] > 0 && failure_of(Outcome{.verdict = {.fault = fault}}) == FailureKind::fault)
      reasons.push_back(fmt::format("{} {}", with_separators(counts.faults[i]), fault_names[i]));
  }
  return fmt::format("NO ANSWER ({})", fmt::join(reasons, ", "));
}

/// "SLOW in 7 queries (3 over the time limit, 4 not asked after that)"
std::string slow_text(const Counts& counts) {
  std::string text = fmt::format("SLOW in {} ({} over the time limit",
                                 counted(failure_info(FailureKind::slow).count(counts), "query", "queries"),
                                 with_separators(counts.without_answer(Fault::time)));
  if (counts.without_answer(Fault::not_asked) > 0)
    text +=
        fmt::format(", {} not asked after that", with_separators(counts.without_answer(Fault::not_asked)));
  return text + ")";
}

/// "12 false positives, 3 of them unknown, the farthest at 0.5 of the bound". The distance of an unknown
/// answer is not measured.
std::string false_positive_text(const Counts& counts) {
  if (counts.false_positives == 0) return "no false positive";
  const std::uint64_t unknown = counts.false_by_stage[static_cast<std::size_t>(Stage::unknown)];
  std::string text = counted(counts.false_positives, "false positive", "false positives");
  if (unknown == counts.false_positives) return text + ", all unknown";
  if (unknown > 0) text += fmt::format(", {} of them unknown", with_separators(unknown));
  return text + ", the farthest " + times_the_bound(counts.max_ratio(), counts.distance_unit());
}

/// The text of a verdict on a subject that has answered nothing.
std::string unjudged_text(const Counts& counts) {
  if (counts.queries == 0) return "NOT ASKED: it decides no query of this sort";
  if (failure_info(FailureKind::slow).count(counts) == 0)
    return fmt::format("NOT ASKED: {} beyond its contract", counted(counts.queries, "query", "queries"));
  return "NO ANSWER IN TIME, " + slow_text(counts);
}

/// How often a failure happened, for each class of families. A query may be of another class than its family.
/// If the least exotic class of the failed queries is not the least exotic class of the families with
/// failures, the text begins with the failed queries of the former class: "3 ordinary vt collisions in
/// extreme families; in all 40 of 5,000 in extreme families".
std::string failed_text(const OfSubject& subject, const FailureInfo& failure) {
  const auto in_queries = class_of_queries(subject, failure);
  if (!in_queries || *in_queries == least_exotic_part(subject.parts, failure)->first)
    return class_by_class(subject.parts, failure);
  return fmt::format("{}; in all {}", said_of_queries(subject.parts, failure, *in_queries, {}),
                     by_families(subject.parts, failure));
}

/// The parts of a verdict, the gravest failure first.
std::vector<std::string> verdict_parts(const Failures& failures, const OfSubject& subject) {
  const Counts& counts = subject.all;
  std::vector<std::string> parts;
  const auto add_by_class = [&](FailureKind kind, std::string_view words) {
    if (failures.contains(kind))
      parts.push_back(fmt::format("{} {}", words, failed_text(subject, failure_info(kind))));
  };
  const bool is_slow_first = failures.contains(FailureKind::unjudged);
  if (is_slow_first) parts.push_back(slow_text(counts));
  if (!failures.contains(FailureKind::miss))
    parts.push_back(fmt::format("no miss in {}", counted(counts.collisions, "collision", "collisions")));
  add_by_class(FailureKind::miss, "MISSED");
  add_by_class(FailureKind::late, "LATE");
  add_by_class(FailureKind::unsafe_step, "UNSAFE STEPS");
  add_by_class(FailureKind::beyond_bound, "BEYOND ITS BOUND");
  add_by_class(FailureKind::fault, no_answer(counts));
  if (failures.contains(FailureKind::committed))
    parts.push_back(fmt::format("{} of {} sound times lead to a step that touches, once rounded",
                                with_separators(counts.committed),
                                with_separators(counts.times_promised - counts.late)));
  if (failures.contains(FailureKind::slow) && !is_slow_first) parts.push_back(slow_text(counts));
  if (failures.contains(FailureKind::unknown))
    parts.push_back(fmt::format("UNKNOWN in {} of {}", with_separators(counts.unknown()),
                                counted(counts.queries, "query", "queries")));
  parts.push_back(false_positive_text(counts));
  return parts;
}

/// The text of a verdict on a subject that answered. Commas separate the parts of the text. If one of the
/// parts is a list of classes, which itself has semicolons, then semicolons separate the parts.
std::string answered_text(const Failures& failures, const OfSubject& subject) {
  const bool has_list = !in_common(failures, {FailureKind::miss, FailureKind::late, FailureKind::unsafe_step,
                                              FailureKind::beyond_bound, FailureKind::fault})
                             .empty();
  std::string text = fmt::format("{}", fmt::join(verdict_parts(failures, subject), has_list ? "; " : ", "));
  if (failures.contains(FailureKind::contract))
    text += fmt::format("; {} not asked, beyond its contract",
                        counted(subject.all.without_answer(Fault::contract), "query", "queries"));
  return text;
}

SubjectVerdict verdict_on(const std::string& name, const OfSubject& subject, const Failures& failing) {
  SubjectVerdict verdict{.subject = name, .failures = failures_of(name, subject.all), .text = {}, .said = {}};
  if (!is_beyond_contract(name)) say_failures(subject, failing, verdict);
  const bool says_nothing = verdict.failures.contains(FailureKind::unjudged) && !has_answered(subject.all);
  verdict.text = says_nothing ? unjudged_text(subject.all) : answered_text(verdict.failures, subject);
  return verdict;
}

}  // namespace

std::vector<SubjectVerdict> subject_verdicts(const Statistics& statistics, const Failures& failing) {
  std::vector<SubjectVerdict> verdicts;
  for (const auto& [name, subject] : by_subject(statistics))
    verdicts.push_back(verdict_on(name, subject, failing));
  return verdicts;
}

std::string oracle_complaint(const Statistics& statistics) {
  std::string text;
  if (statistics.oracle_disagreements > 0)
    text = counted(statistics.oracle_disagreements, "ORACLE DISAGREEMENT", "ORACLE DISAGREEMENTS");
  if (statistics.mismatches_with_recorded_truth > 0)
    text += (text.empty() ? "" : ", ") + counted(statistics.mismatches_with_recorded_truth,
                                                 "MISMATCH of the oracle with the recorded truth",
                                                 "MISMATCHES of the oracle with the recorded truth");
  return text;
}

std::string verdict_lines(const Statistics& statistics, const Failures& failing) {
  std::string lines;
  for (const SubjectVerdict& each : subject_verdicts(statistics, failing))
    lines += fmt::format("{} {}: {}\n",
                         is_beyond_contract(each.subject) ? " -- "
                         : each.clean                     ? " ok "
                                                          : "FAIL",
                         each.subject, each.text);
  if (const std::string complaint = oracle_complaint(statistics); !complaint.empty())
    lines += fmt::format("FAIL oracle: {}\n", complaint);
  return lines;
}

}  // namespace nearmiss
