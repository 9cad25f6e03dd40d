#include "reports/sections/summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "corpus/query_text.hpp"
#include "reports/sections/class_table.hpp"
#include "reports/sections/common_factors_table.hpp"
#include "reports/sections/time_table.hpp"
#include "reports/sections/version_table.hpp"
#include "reports/statistics/confidence.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

std::string meaning(const Extreme& extreme) {
  if (extreme.of == Extreme::Of::distance)
    return extreme.found() ? fmt::format("reach {:.4g} of the bound", extreme.value) : "no false positive";
  if (!extreme.found()) return "no miss found with any factor";
  return fmt::format("misses found with factors {} {:.3g}",
                     extreme.of == Extreme::Of::accepting_tolerance ? "<=" : ">=", extreme.value);
}

/// The upper confidence bound of the rate of misses, if the queries are a random sample.
std::string rate_below(const CountsSum& sum) {
  if (!sum.is_sample) return "-";
  return fmt::format("{:.2g}", clopper_pearson_upper(sum.counts.false_negatives, sum.counts.collisions));
}

std::string extremes_table(const std::map<std::string, Extreme>& extremes) {
  std::vector<std::vector<std::string>> rows{{"tolerance or tests", "result", "queries", "from"}};
  for (const auto& [name, each] : extremes)
    rows.push_back({name, meaning(each), with_separators(each.queries), each.provenance});
  return columns(rows, 1);
}

}  // namespace

bool found_anything(const Statistics& statistics) {
  return statistics.false_negatives() + statistics.late() + statistics.refuted_bounds() +
             statistics.oracle_disagreements + statistics.mismatches_with_recorded_truth >
         0;
}

namespace {

/// The queries that a subject was not asked because they break its contract. They say nothing against it.
std::uint64_t beyond_contract(const Counts& counts) {
  return counts.faults[static_cast<std::size_t>(Fault::contract)];
}

/// "NO ANSWER to 3 queries (2 crash, 1 time)"
std::string fault_text(const Counts& counts) {
  std::vector<std::string> faults;
  for (std::size_t i = 1; i < fault_count; ++i)
    if (counts.faults[i] != 0 && i != static_cast<std::size_t>(Fault::contract))
      faults.push_back(fmt::format("{} {}", with_separators(counts.faults[i]), fault_names[i]));
  return fmt::format("NO ANSWER to {} ({})",
                     counted(counts.faults_total() - beyond_contract(counts), "query", "queries"),
                     fmt::join(faults, ", "));
}

/// "12 false positives, 3 of them unknown, the farthest at 0.5 of the bound". The distance of an unknown answer is not measured.
std::string false_positive_text(const Counts& counts) {
  if (counts.false_positives == 0) return "no false positive";
  const std::uint64_t unknown = counts.false_by_stage[static_cast<std::size_t>(Stage::unknown)];
  std::string text = counted(counts.false_positives, "false positive", "false positives");
  if (unknown == counts.false_positives) return text + ", all unknown";
  if (unknown > 0) text += fmt::format(", {} of them unknown", with_separators(unknown));
  return text + ", the farthest " + times_the_bound(counts.max_ratio(), counts.distance_unit());
}

SubjectVerdict verdict_on(const std::string& subject, const Counts& counts) {
  const bool missed = counts.false_negatives > 0;
  const bool faulty = counts.faults_total() > beyond_contract(counts);
  const bool late = counts.late > 0;
  const bool refuted = counts.refuted_bounds > 0;
  std::string text =
      missed ? fmt::format("MISSED {} of ", with_separators(counts.false_negatives)) : "no miss in ";
  text += counted(counts.collisions, "collision", "collisions");
  if (late)
    text += fmt::format(", LATE in {} of {}", with_separators(counts.late),
                        counted(counts.times_promised, "time", "times"));
  if (faulty) text += ", " + fault_text(counts);
  if (refuted) text += fmt::format(", {} BEYOND ITS BOUND", with_separators(counts.refuted_bounds));
  if (counts.unknown() > 0)
    text += fmt::format(", UNKNOWN in {} of {}", with_separators(counts.unknown()),
                        counted(counts.queries, "query", "queries"));
  text += ", " + false_positive_text(counts);
  if (beyond_contract(counts) > 0)
    text += fmt::format("; {} not asked, beyond its contract",
                        counted(beyond_contract(counts), "query", "queries"));
  return {subject, !missed && !late && !refuted && !faulty, std::move(text)};
}

}  // namespace

std::vector<SubjectVerdict> subject_verdicts(const Statistics& statistics) {
  std::map<std::string, Counts> by_subject;
  for (const auto& [key, counts] : statistics.counts) by_subject[key.subject].merge(counts);
  std::vector<SubjectVerdict> verdicts;
  for (const auto& [subject, counts] : by_subject) verdicts.push_back(verdict_on(subject, counts));
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

namespace {

std::string counts_table(const Statistics& statistics) {
  std::vector<std::vector<std::string>> rows{{"subject", "kind", "queries", "collisions", "false neg.",
                                              "rate below*", "late", "false pos.", "max dist/bound",
                                              "ns/query"}};
  for (const auto& [key, sum] : statistics.by_subject_and_kind()) {
    const Counts& counts = sum.counts;
    rows.push_back({key.subject, std::string(short_name(key.kind)), with_separators(counts.queries),
                    with_separators(counts.collisions), with_separators(counts.false_negatives),
                    rate_below(sum), late_times(counts), with_separators(counts.false_positives),
                    marked_fraction_of_bound(counts.max_ratio(), counts.distance_unit()),
                    whole_ns(counts.times.ns_per_query())});
  }
  return columns(rows, 2);
}

/// Explains the mark of distances that are not fractions of a claim; "" if there are none.
std::string footnote_on_units(const Statistics& statistics) {
  const bool is_marked = std::any_of(
      statistics.counts.begin(), statistics.counts.end(),
      [](const auto& each) { return each.second.distance_unit() != DistanceUnit::claimed_bound; });
  return is_marked ? std::string(unit_footnote) + "\n" : "";
}

std::string verdict_lines(const Statistics& statistics) {
  std::string lines;
  for (const SubjectVerdict& each : subject_verdicts(statistics))
    lines += fmt::format("{} {}: {}\n", each.clean ? " ok " : "FAIL", each.subject, each.text);
  if (const std::string complaint = oracle_complaint(statistics); !complaint.empty())
    lines += fmt::format("FAIL oracle: {}\n", complaint);
  return lines;
}

std::string oracle_lines(const Statistics& statistics) {
  const OracleCounts oracle = statistics.oracle_total();
  const std::string near_bounds = oracle.near_bounds == 0 ? ""
                                                          : fmt::format(", {} decided near their bounds",
                                                                        with_separators(oracle.near_bounds));
  return fmt::format(
      "oracle: {} queries, {} left to exact arithmetic by the filters{}; {} decided by all exact methods: "
      "{}, and {} of {} collisions\nhave an even number of roots, which root parity cannot see\n",
      with_separators(oracle.queries),
      with_separators(oracle.by_stage[static_cast<std::size_t>(FilterStage::undecided)]), near_bounds,
      with_separators(oracle.compared), statistics.oracle_disagreements == 0 ? "they agree" : "THEY DISAGREE",
      with_separators(oracle.missed_by_parity), with_separators(oracle.compared_collisions));
}

constexpr const char* footnotes =
    "\n* upper 95 % confidence bound of the rate of misses among true collisions, if all are random "
    "(Clopper-Pearson)\nns/query: without waiting for a processor, less that of an empty subject; the "
    "median over batches of each family\n";

}  // namespace

std::string summary_table(const Statistics& statistics) {
  std::string extremes = statistics.extremes.empty() ? "" : extremes_table(statistics.extremes);
  if (statistics.counts.empty() && oracle_complaint(statistics).empty()) return extremes;
  std::string classes = class_table(statistics);
  if (!classes.empty()) classes += "\n";
  std::string times = time_table(statistics);
  if (!times.empty()) times += "\n";
  std::string common = common_factors_lines(statistics);
  if (!common.empty()) common += "\n";
  return verdict_lines(statistics) + version_lines(statistics) + "\n" + counts_table(statistics) + "\n" +
         times + classes + common + oracle_lines(statistics) + extremes + footnotes +
         footnote_on_units(statistics);
}

}  // namespace nearmiss
