#include "tools/one_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "fuzz/families/classify.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "oracle/distance.hpp"
#include "oracle/earliest_time.hpp"
#include "oracle/explanation.hpp"
#include "oracle/oracle.hpp"
#include "reports/sections/sections.hpp"
#include "reports/sections/verdicts.hpp"
#include "reports/statistics/sums.hpp"
#include "reports/text/shell.hpp"
#include "reports/text/text.hpp"
#include "tools/record.hpp"
#include "tools/terminal_picture.hpp"

namespace nearmiss::tools {

namespace {

constexpr std::size_t most_lines = 12;
constexpr std::size_t columns = 100;

/// The first finding about a subject; null if there is none.
const Finding* finding_of(const Campaign& campaign, const std::string& subject) {
  for (const Run& run : campaign.runs)
    for (const Finding& each : run.findings)
      if (each.subject == subject) return &each;
  return nullptr;
}

/// Says that a subject reports the collision, and how far its time is from t*, the exact earliest time.
std::string reported(const Counts& counts) {
  const std::string text = "reports the collision";
  if (counts.times_given == 0) return text;
  if (counts.max_after() > 0) return text + fmt::format(", {:.3g} of the step after t*", counts.max_after());
  if (counts.max_early() > 0) return text + fmt::format(", {:.3g} of the step before t*", counts.max_early());
  return text + " at t*";
}

std::string answer(const SubjectVerdict& verdict, const Counts& counts, const Finding* finding) {
  const auto has = [&](FailureKind kind) { return verdict.failures.contains(kind); };
  if (has(FailureKind::miss)) return "MISSED the collision";
  if (has(FailureKind::late))
    return fmt::format("LATE, by {:.3g} of the step", finding == nullptr ? 0 : finding->ratio);
  if (has(FailureKind::fault) && finding != nullptr)
    return "NO ANSWER: " + finding->signature.substr(finding->signature.find(' ') + 1);
  const std::uint64_t answered = counts.queries - counts.faults_total();
  if (answered == 0) return verdict.text;
  if (counts.unknown() > 0) return "cannot tell";
  if (counts.false_positives > 0)
    return fmt::format("{} {}",
                       has(FailureKind::beyond_bound) ? "BEYOND ITS BOUND: false positive" : "false positive",
                       times_the_bound(counts.max_ratio(), counts.distance_unit()));
  if (has(FailureKind::unsafe_step) || has(FailureKind::committed))
    return reported(counts) + "; the step to its time touches, once rounded";
  return counts.collisions > 0 ? reported(counts) : "reports no collision";
}

/// The truth about a query: "first contact at t* = 0.5" or, without a contact, how close the primitives come.
std::string exact_answer(const Query& query) {
  const double h = query.separation;
  const Decision decision = decide(query);
  if (!decision.collision && !decision.is_tie)
    return fmt::format("{}; the smallest distance is {:.6g}",
                       h > 0 ? fmt::format("never within {:.6g}", h) : "no contact",
                       minimum_distance(query).hi);
  return fmt::format("{} at t* = {:.6g}", h > 0 ? fmt::format("first within {:.6g}", h) : "first contact",
                     EarliestTime(query).enclosure().lo);
}

/// The class and the kind of a query, and for a degenerate query the reason for its class: "degenerate vt
/// query (coplanar at an end)".
std::string class_text(const Query& query) {
  const QueryClass of = classify(query);
  const std::string_view why = why_not_ordinary(query);
  return fmt::format("{} {} query{}", name(of), short_name(query.kind),
                     of == QueryClass::degenerate ? fmt::format(" ({})", why) : "");
}

/// A line for each subject, the failing ones first.
std::vector<std::string> verdicts(const Campaign& campaign, const Failures& failing) {
  auto all = subject_verdicts(campaign.statistics, failing);
  std::stable_partition(all.begin(), all.end(), [](const auto& each) { return !each.clean; });
  const auto sums = sums_by(campaign.statistics, &CountsKey::subject);
  std::vector<std::string> lines;
  for (const SubjectVerdict& each : all) {
    const bool counts = !is_beyond_contract(each.subject);
    lines.push_back(fmt::format(
        "{} {}: {}",
        !counts      ? " -- "
        : each.clean ? " ok "
                     : "FAIL",
        each.subject, answer(each, sums.at(each.subject).counts, finding_of(campaign, each.subject))));
  }
  return lines;
}

/// The commands that simplify the query for the first subject that fails. There are no such commands if no
/// subject fails, or if the query is not the only one of a file.
std::vector<std::string> commands(const OneCase& one, const Campaign& campaign, const Subjects& subjects,
                                  const Failures& failing) {
  if (one.file.empty()) return {};
  const auto all = subject_verdicts(campaign.statistics, failing);
  const auto failed = std::ranges::find(all, false, &SubjectVerdict::clean);
  if (failed == all.end() || finding_of(campaign, failed->subject) == nullptr) return {};
  const auto subject =
      std::ranges::find_if(subjects, [&](const auto& each) { return each->name() == failed->subject; });
  if (subject == subjects.end()) return {};
  const std::string shrink = fmt::format("nearmiss shrink {} --subject {}{}", shell_quoted(one.file),
                                         shell_quoted(text_of(**subject)), one.options);
  return {"simplify it: " + shrink, "as a test:   " + shrink + " --as c++"};
}

}  // namespace

std::string describe(const OneCase& one, const Campaign& campaign, const Subjects& subjects,
                     const Failures& failing) {
  std::vector<std::string> after;
  if (const std::string complaint = oracle_complaint(campaign.statistics); !complaint.empty())
    after.push_back("FAIL oracle: " + complaint);
  std::istringstream versions(version_lines(campaign.statistics));
  for (std::string line; std::getline(versions, line);) after.push_back(line);
  const auto add = [&](const std::string& text) {
    std::istringstream wrapped_lines(wrapped(text, "       ", 2, columns));
    for (std::string line; std::getline(wrapped_lines, line);) after.push_back(line);
  };
  add(fmt::format("exact: {}; {}", exact_answer(one.query), class_text(one.query)));
  add("       " + to_text(explain(one.query)));
  std::istringstream vertices(vertex_lines(one.query, columns));
  for (std::string line; std::getline(vertices, line);) after.push_back(line);
  const auto last = commands(one, campaign, subjects, failing);

  std::vector<std::string> lines = verdicts(campaign, failing);
  const std::size_t room = most_lines - std::min(most_lines - 1, after.size() + last.size());
  if (lines.size() > room) {
    const std::size_t left = lines.size() - (room - 1);
    lines.resize(room - 1);
    lines.push_back(
        fmt::format("      and {}: -v shows all", counted(left, "more subject", "more subjects")));
  }
  lines.insert(lines.end(), after.begin(), after.end());
  for (const Run& run : campaign.runs)
    for (const Finding& each : run.findings) {
      const std::size_t left = most_lines - std::min(most_lines, lines.size() + last.size());
      for (std::string& line : stderr_lines(each, left)) lines.push_back(std::move(line));
    }
  lines.insert(lines.end(), last.begin(), last.end());
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

}  // namespace nearmiss::tools
