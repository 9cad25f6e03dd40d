#include "reports/sections/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "corpus/query_text.hpp"
#include "reports/sections/class_table.hpp"
#include "reports/sections/common_factors_table.hpp"
#include "reports/sections/time_table.hpp"
#include "reports/sections/verdicts.hpp"
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

std::string summary_table(const Statistics& statistics, const Failures& failing) {
  std::string extremes = statistics.extremes.empty() ? "" : extremes_table(statistics.extremes);
  if (statistics.counts.empty() && oracle_complaint(statistics).empty()) return extremes;
  std::string classes = class_table(statistics);
  if (!classes.empty()) classes += "\n";
  std::string times = time_table(statistics);
  if (!times.empty()) times += "\n";
  std::string common = common_factors_lines(statistics);
  if (!common.empty()) common += "\n";
  return verdict_lines(statistics, failing) + "\n" + counts_table(statistics) + "\n" + times + classes +
         common + oracle_lines(statistics) + extremes + footnotes + footnote_on_units(statistics);
}

}  // namespace nearmiss
