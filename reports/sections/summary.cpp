#include "reports/sections/sections.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "reports/sections/measures.hpp"
#include "reports/sections/verdicts.hpp"
#include "reports/statistics/family.hpp"
#include "reports/text/json.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

/// A number that is shown for each pair of versions.
struct VersionMeasure {
  std::string_view key;  ///< in report.json
  /// the words that follow the number on the terminal; "" if the terminal does not show the number
  std::string_view text;
  std::uint64_t (*value)(const VersionCounts&);
};

constexpr std::array measures{
    VersionMeasure{"fixed", "fixed", [](const VersionCounts& counts) { return counts.fixed; }},
    VersionMeasure{"broken", "broken", [](const VersionCounts& counts) { return counts.broken; }},
    VersionMeasure{"both", "both fail", [](const VersionCounts& counts) { return counts.both; }},
    VersionMeasure{"neither", "", [](const VersionCounts& counts) { return counts.neither; }},
    VersionMeasure{"queries", "", [](const VersionCounts& counts) { return counts.queries(); }},
};

using Versions = std::pair<std::string, std::string>;  // before and after
using Part = std::pair<QueryClass, Kind>;
using VersionParts = std::map<Part, VersionCounts>;

std::map<Versions, VersionParts> by_class_and_kind(const VersionTable& table) {
  std::map<Versions, VersionParts> sums;
  for (const auto& [key, counts] : table)
    sums[{key.before, key.after}][{class_of(key.family), key.kind}].merge(counts);
  return sums;
}

/// "12 fixed, 3 broken"
std::string in_words(const VersionCounts& counts, bool shows_zeros) {
  std::vector<std::string> words;
  for (const VersionMeasure& each : measures)
    if (const std::uint64_t value = each.value(counts); !each.text.empty() && (value != 0 || shows_zeros))
      words.push_back(fmt::format("{} {}", with_separators(value), each.text));
  return fmt::format("{}", fmt::join(words, ", "));
}

/// Whether a subject was asked any queries of a kind; queries that its contract excludes do not count.
bool was_asked(const std::string& subject, Kind kind, const Statistics& statistics) {
  return std::any_of(statistics.counts.begin(), statistics.counts.end(), [&](const auto& each) {
    const auto& [key, counts] = each;
    return key.subject == subject && key.kind == kind &&
           counts.queries > counts.without_answer(Fault::contract) + counts.without_answer(Fault::not_asked);
  });
}

/// "; ee not compared, because old was not asked about it", for each kind that only one of the two versions
/// was asked about.
std::string not_compared(const Versions& versions, const VersionParts& parts, const Statistics& statistics) {
  std::map<Kind, std::uint64_t> compared;
  for (const auto& [part, counts] : parts) compared[part.second] += counts.queries();
  std::string text;
  for (const auto& [kind, queries] : compared) {
    const bool before = was_asked(versions.first, kind, statistics);
    const bool after = was_asked(versions.second, kind, statistics);
    if (queries == 0 && before != after)
      text += fmt::format("; {} not compared, because {} was not asked about it", short_name(kind),
                          before ? versions.second : versions.first);
  }
  return text;
}

}  // namespace

std::string version_lines(const Statistics& statistics) {
  std::string lines;
  for (const auto& [versions, parts] : by_class_and_kind(statistics.versions)) {
    VersionCounts sum;
    std::vector<std::string> words;
    for (const auto& [part, counts] : parts) {
      sum.merge(counts);
      if (const std::string own = in_words(counts, false); !own.empty())
        words.push_back(fmt::format("{} {} {}", name(part.first), short_name(part.second), own));
    }
    if (sum.queries() == 0) {
      lines += fmt::format("{} against {}: no query was asked of both{}\n", versions.second, versions.first,
                           not_compared(versions, parts, statistics));
      continue;
    }
    lines += fmt::format("{} against {}: {}, of {}{}{}\n", versions.second, versions.first,
                         in_words(sum, true), counted(sum.queries(), "query", "queries"),
                         words.empty() ? "" : fmt::format(" ({})", fmt::join(words, "; ")),
                         not_compared(versions, parts, statistics));
  }
  return lines;
}

nlohmann::ordered_json versions_json(const Statistics& statistics) {
  auto json = nlohmann::ordered_json::array();
  for (const auto& [versions, parts] : by_class_and_kind(statistics.versions)) {
    const bool compares =
        std::any_of(parts.begin(), parts.end(), [](const auto& part) { return part.second.queries() != 0; });
    for (const auto& [part, counts] : parts) {
      if (compares && counts.queries() == 0) continue;
      json.push_back({{"before", versions.first},
                      {"after", versions.second},
                      {"kind", short_name(part.second)},
                      {"class", name(part.first)}});
      for (const VersionMeasure& each : measures) json.back()[std::string(each.key)] = each.value(counts);
    }
  }
  return json;
}

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

/// Explains the mark "**" of distances that are not fractions of a claimed bound; "" if no distance has this
/// mark.
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

std::string spaced(const std::string& text) { return text.empty() ? "" : text + "\n"; }

/// A table with a row for each subject, kind and class. A row has the sort of the subject's times, the
/// numbers of times that are late or stuck at 0, and how early or late the times are. "" if no subject gives
/// times.
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
