#include "reports/sections/sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "reports/sections/measures.hpp"
#include "reports/sections/verdicts.hpp"
#include "reports/statistics/family.hpp"
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

std::string extremes_table(const std::map<std::string, Extreme>& extremes) {
  std::vector<std::vector<std::string>> rows{{"tolerance or tests", "result", "queries", "from"}};
  for (const auto& [name, each] : extremes)
    rows.push_back({name, meaning(each), with_separators(each.queries), each.provenance});
  return columns(rows, 1);
}

std::string counts_table(const Statistics& statistics) {
  const auto cells = [](const CountsKey& key) {
    return std::vector{key.subject, std::string(short_name(key.kind))};
  };
  return table(statistics.by_subject_and_kind(), {"subject", "kind"}, cells,
               {"queries", "collisions", "false_negatives", "false_negative_rate_upper_95", "late",
                "false_positives", "max_fp_distance_over_bound", "ns_per_query"},
               2);
}

std::vector<std::string> cells_of(const ClassKey& key) {
  return {key.subject, std::string(short_name(key.kind)), std::string(name(key.of))};
}

constexpr const char* footnote_on_times =
    "early: t* - time, where t* is the exact earliest time, of times that are not after t*; late: something "
    "happens before a time\nthat is to be a lower bound; committed: it is sound, but the step to it, x0 + "
    "time (x1 "
    "- x0) in the subject's scalar, has contact before\nits end; stuck: the time is 0, and t* is not; "
    "invalid: "
    "a time that is none, or a collision without the time that is promised\n";

/// Explains the mark "**" of distances that are not fractions of a claimed bound; "" if there are none.
std::string footnote_on_units(const Statistics& statistics) {
  const bool is_marked = std::any_of(
      statistics.counts.begin(), statistics.counts.end(),
      [](const auto& each) { return each.second.distance_unit() != DistanceUnit::claimed_bound; });
  return is_marked ? std::string(unit_footnote) + "\n" : "";
}

std::string certified_line(const OracleCounts& oracle) {
  if (oracle.certified == 0) return "";
  return counted(oracle.certified, "recorded truth is", "recorded truths are") + " certified\n";
}

std::string oracle_lines(const Statistics& statistics) {
  const OracleCounts oracle = statistics.oracle_total();
  const std::string near_bounds = oracle.near_bounds == 0 ? ""
                                                          : fmt::format(", {} decided near their bounds",
                                                                        with_separators(oracle.near_bounds));
  return fmt::format(
      "oracle: {} queries, {} left to exact arithmetic by the filters{}; {} decided by all exact methods: "
      "{}, and {} of {} collisions\nhave an even number of roots, which root parity cannot see\n{}",
      with_separators(oracle.queries),
      with_separators(oracle.by_stage[static_cast<std::size_t>(FilterStage::undecided)]), near_bounds,
      with_separators(oracle.compared), statistics.oracle_disagreements == 0 ? "they agree" : "THEY DISAGREE",
      with_separators(oracle.missed_by_parity), with_separators(oracle.compared_collisions),
      certified_line(oracle));
}

constexpr const char* footnotes =
    "\n* upper 95 % confidence bound of the rate of misses among true collisions, if all are random "
    "(Clopper-Pearson)\nns/query: without waiting for a processor, less that of an empty subject; the "
    "median over batches of each family\n";

/// A table followed by an empty line; "" for an empty table.
std::string spaced(const std::string& text) { return text.empty() ? "" : text + "\n"; }

/// A table with a row for each subject, kind and class. A row has the sort of the subject's times, how many
/// of them are late or stuck at 0, and how early or late they are. "" if no subject gives times.
std::string time_table(const Statistics& statistics) {
  auto sums = by_class(statistics);
  std::erase_if(sums, [](const auto& each) {
    const Counts& counts = each.second.counts;
    return counts.times_given == 0 && counts.without_answer(Fault::invalid) == 0;
  });
  if (sums.empty()) return "";
  return table(sums, {"subject", "kind", "class"}, cells_of,
               {"time_sort", "times_given", "late", "committed", "stuck", "invalid", "unknown",
                "median_early", "q99_early", "max_early", "max_after"},
               4) +
         footnote_on_times;
}

/// A table with a row for each subject, kind and class; "" if all queries are of one class.
std::string class_table(const Statistics& statistics) {
  const auto sums = by_class(statistics);
  std::set<QueryClass> classes;
  for (const auto& [key, sum] : sums) classes.insert(key.of);
  if (classes.size() < 2) return "";
  return table(sums, {"subject", "kind", "class"}, cells_of,
               {"queries", "collisions", "false_negatives", "late", "false_positives", "ns_per_query"}, 3);
}

}  // namespace

std::string summary_lines(const Statistics& statistics, const Failures& failing) {
  const bool has_subjects = !statistics.counts.empty() || !oracle_complaint(statistics).empty();
  return (has_subjects ? verdict_lines(statistics, failing) + version_lines(statistics) : "") +
         certified_line(statistics.oracle_total()) +
         (statistics.extremes.empty() ? "" : extremes_table(statistics.extremes));
}

std::string summary_table(const Statistics& statistics, const Failures& failing) {
  const std::string extremes = statistics.extremes.empty() ? "" : extremes_table(statistics.extremes);
  if (statistics.counts.empty() && oracle_complaint(statistics).empty()) return extremes;
  return verdict_lines(statistics, failing) + version_lines(statistics) + "\n" +
         spaced(sizes_table(statistics)) + spaced(counts_table(statistics)) + spaced(time_table(statistics)) +
         spaced(class_table(statistics)) + spaced(common_factors_lines(statistics)) +
         oracle_lines(statistics) + extremes + footnotes + footnote_on_units(statistics);
}

}  // namespace nearmiss
