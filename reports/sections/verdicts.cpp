#include "reports/sections/verdicts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "reports/statistics/family_class.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

/// The counters of a subject by class and kind.
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

/// "ordinary vt 53 of 504, ee 0 of 701; degenerate 1,204 of 5,001": how often a subject failed in this way,
/// class by class, and in the first class kind by kind. Leaves out classes and kinds in which nothing could
/// fail, and the name of the class if all queries are unclassified.
std::string class_by_class(const Parts& parts, const FailureInfo& failure) {
  const auto of = [](std::uint64_t count, std::uint64_t total) {
    return fmt::format("{} of {}", with_separators(count), with_separators(total));
  };
  std::vector<std::string> classes;
  for (const auto& [in, by_kind] : parts) {
    std::vector<std::string> by_kind_text;
    std::uint64_t count = 0;
    std::uint64_t total = 0;
    for (const auto& [kind, counts] : by_kind) {
      if (failure.total(counts) == 0) continue;
      by_kind_text.push_back(
          fmt::format("{} {}", short_name(kind), of(failure.count(counts), failure.total(counts))));
      count += failure.count(counts);
      total += failure.total(counts);
    }
    if (total == 0) continue;
    const bool is_first = classes.empty();
    const std::string text = is_first ? fmt::format("{}", fmt::join(by_kind_text, ", ")) : of(count, total);
    const bool is_nameless = is_first && in == QueryClass::unclassified;
    classes.push_back(is_nameless ? text : fmt::format("{} {}", name(in), text));
  }
  return fmt::format("{}", fmt::join(classes, "; "));
}

/// "missed 53 of 504 ordinary vt collisions": how often a subject failed in a class, for each kind with
/// failures.
std::string said_of(const FailureInfo& failure, QueryClass in, const std::map<Kind, Counts>& by_kind) {
  std::vector<std::string> kinds_text;
  std::uint64_t total = 0;
  for (const auto& [kind, counts] : by_kind) {
    if (failure.count(counts) == 0) continue;
    total = failure.total(counts);
    kinds_text.push_back(
        fmt::format("{} of {} {}{}", with_separators(failure.count(counts)), with_separators(total),
                    in == QueryClass::unclassified ? "" : fmt::format("{} ", name(in)), short_name(kind)));
  }
  const bool is_one = kinds_text.size() == 1 && total == 1;
  return fmt::format("{} {} {}", failure.verb, fmt::join(kinds_text, " and "),
                     is_one ? failure.one : failure.many);
}

/// The least exotic class of families in which a subject failed in this way.
Parts::const_iterator least_exotic_part(const Parts& parts, const FailureInfo& failure) {
  const auto has_failed = [&](const auto& of_kind) { return failure.count(of_kind.second) > 0; };
  return std::find_if(parts.begin(), parts.end(), [&](const auto& part) {
    return std::any_of(part.second.begin(), part.second.end(), has_failed);
  });
}

/// The least exotic class of the queries that a subject missed, if it is less exotic than the class of every
/// family with a miss; nothing otherwise.
std::optional<QueryClass> class_of_missed(const OfSubject& subject) {
  const auto& missed = subject.all.missed_by_class;
  const auto in = least_exotic_part(subject.parts, failure_info(FailureKind::miss));
  for (std::size_t i = 0; i < missed.size(); ++i)
    if (missed[i] > 0 && static_cast<QueryClass>(i) < in->first) return static_cast<QueryClass>(i);
  return std::nullopt;
}

/// "missed 12 ordinary vt collisions in degenerate families": what a subject missed among the queries of a
/// class.
std::string said_of_queries(const Parts& parts, QueryClass of) {
  std::map<Kind, std::uint64_t> by_kind;
  std::set<QueryClass> families;
  for (const auto& [in, kinds] : parts)
    for (const auto& [kind, counts] : kinds)
      if (const auto count = counts.missed_by_class[static_cast<std::size_t>(of)]; count > 0) {
        by_kind[kind] += count;
        families.insert(in);
      }
  families.erase(QueryClass::unclassified);
  std::vector<std::string> kinds_text;
  for (const auto& [kind, count] : by_kind)
    kinds_text.push_back(fmt::format("{} {} {}", with_separators(count), name(of), short_name(kind)));
  std::vector<std::string_view> names;
  for (const QueryClass each : families) names.push_back(name(each));
  const bool is_one = by_kind.size() == 1 && by_kind.begin()->second == 1;
  return fmt::format("missed {} {}{}", fmt::join(kinds_text, " and "), is_one ? "collision" : "collisions",
                     names.empty() ? "" : fmt::format(" in {} families", fmt::join(names, " and ")));
}

/// Puts the failures that count into words, each for the least exotic class in which it was seen: the class
/// of the families, or that of the missed queries if it is less exotic.
void say_failures(const OfSubject& subject, const Failures& failing, SubjectVerdict& verdict) {
  for (const FailureKind kind : in_common(verdict.failures, failing)) {
    verdict.clean = false;
    if (kind == FailureKind::not_asked) {
      verdict.said[kind] = verdict.first = failure_info(kind).verb;
      continue;
    }
    const auto in = least_exotic_part(subject.parts, failure_info(kind));
    if (in == subject.parts.end()) continue;
    const auto missed = kind == FailureKind::miss ? class_of_missed(subject) : std::nullopt;
    verdict.said[kind] =
        missed ? said_of_queries(subject.parts, *missed) : said_of(failure_info(kind), in->first, in->second);
    const QueryClass least_exotic = missed.value_or(in->first);
    if (!verdict.first.empty() && least_exotic >= verdict.least_exotic) continue;
    verdict.first = verdict.said[kind];
    verdict.least_exotic = least_exotic;
  }
}

/// "NO ANSWER to 3 queries (2 crash, 1 exception)"
std::string fault_text(const Counts& counts) {
  std::vector<std::string> reasons;
  for (const Fault each : {Fault::error, Fault::crash, Fault::memory, Fault::exception, Fault::protocol,
                           Fault::invalid, Fault::load})
    if (counts.without_answer(each) > 0)
      reasons.push_back(fmt::format("{} {}", with_separators(counts.without_answer(each)),
                                    fault_names[static_cast<std::size_t>(each)]));
  return fmt::format("NO ANSWER to {} ({})",
                     counted(failure_info(FailureKind::fault).count(counts), "query", "queries"),
                     fmt::join(reasons, ", "));
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

/// Why nothing is known of a subject.
std::string not_asked_text(const Counts& counts) {
  if (counts.queries == 0) return "NOT ASKED: it decides no query of this sort";
  if (failure_info(FailureKind::slow).count(counts) == 0)
    return fmt::format("NOT ASKED: {} beyond its contract", counted(counts.queries, "query", "queries"));
  return "NO ANSWER IN TIME, " + slow_text(counts);
}

/// The parts of a verdict, the gravest failure first.
std::vector<std::string> verdict_parts(const Failures& failures, const OfSubject& subject) {
  const Counts& counts = subject.all;
  const auto by_classes = [&](std::string_view word, FailureKind kind) {
    return fmt::format("{} {}", word, class_by_class(subject.parts, failure_info(kind)));
  };
  std::vector<std::string> parts{
      failures.contains(FailureKind::miss)
          ? by_classes("MISSED", FailureKind::miss)
          : fmt::format("no miss in {}", counted(counts.collisions, "collision", "collisions"))};
  if (const auto missed = class_of_missed(subject)) {
    const auto count = counts.missed_by_class[static_cast<std::size_t>(*missed)];
    parts.push_back(fmt::format("{} of the missed queries {} {}", with_separators(count),
                                count == 1 ? "is" : "are", name(*missed)));
  }
  if (failures.contains(FailureKind::late)) parts.push_back(by_classes("LATE", FailureKind::late));
  if (failures.contains(FailureKind::beyond_bound))
    parts.push_back(fmt::format("{} BEYOND ITS BOUND", with_separators(counts.refuted_bounds)));
  if (failures.contains(FailureKind::fault)) parts.push_back(fault_text(counts));
  if (failures.contains(FailureKind::slow)) parts.push_back(slow_text(counts));
  if (failures.contains(FailureKind::unknown))
    parts.push_back(fmt::format("UNKNOWN in {} of {}", with_separators(counts.unknown()),
                                counted(counts.queries, "query", "queries")));
  parts.push_back(false_positive_text(counts));
  return parts;
}

/// The text of a verdict on a subject that answered. Its parts are separated by commas, or by semicolons if
/// one of them is a list of classes, which has semicolons itself.
std::string answered_text(const Failures& failures, const OfSubject& subject) {
  const bool has_list = failures.contains(FailureKind::miss) || failures.contains(FailureKind::late);
  std::string text = fmt::format("{}", fmt::join(verdict_parts(failures, subject), has_list ? "; " : ", "));
  if (failures.contains(FailureKind::contract))
    text += fmt::format("; {} not asked, beyond its contract",
                        counted(subject.all.without_answer(Fault::contract), "query", "queries"));
  return text;
}

SubjectVerdict verdict_on(const std::string& name, const OfSubject& subject, const Failures& failing) {
  SubjectVerdict verdict{.subject = name, .failures = failures_of(name, subject.all), .text = {}, .said = {}};
  say_failures(subject, failing, verdict);
  verdict.text = verdict.failures.contains(FailureKind::not_asked) ? not_asked_text(subject.all)
                                                                   : answered_text(verdict.failures, subject);
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
    lines += fmt::format("{} {}: {}\n", each.clean ? " ok " : "FAIL", each.subject, each.text);
  if (const std::string complaint = oracle_complaint(statistics); !complaint.empty())
    lines += fmt::format("FAIL oracle: {}\n", complaint);
  return lines;
}

}  // namespace nearmiss
