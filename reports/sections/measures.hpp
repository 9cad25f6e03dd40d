// The table of measures. A measure is a number that reports compute from a subject's counters; the table also
// gives the measure's names in files and in tables. A section of a report sums counters by some key
// (sums_by), and shows some measures of each sum. This header also converts counters and measures to JSON.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "reports/statistics/statistics.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

/// The value of a measure: nothing, a count, a number, a range that contains a number, or a word.
using Value = std::variant<std::monostate, std::uint64_t, double, Bin, std::string_view>;

/// A measure of a sum of counters, declared once for all files and tables.
struct Measure {
  std::string_view key;              ///< in report.json
  Value (*value)(const CountsSum&);  ///< computes the value that files show from a sum of counters
  std::string_view heading{};        ///< the heading of the measure's column in tables on the terminal
  /// the counter after which CSV files have the measure; "" if they lack the measure
  std::string_view csv_after{};
  /// Makes the text that the terminal shows. If null, the terminal shows the result of `value`.
  std::string (*text)(const CountsSum&) = nullptr;
};

/// The measures that report.json shows for every sum, in the order of report.json.
std::span<const Measure> rate_measures();

/// The measure with this key: one of rate_measures(), or one of the few other measures, which report.json
/// shows only in some places. Throws std::out_of_range if no measure has this key.
const Measure& measure(std::string_view key);

using MeasureKeys = std::vector<std::string_view>;

/// The headings of a table on the terminal: the given cells, then the headings of the measures.
std::vector<std::string> headings(std::vector<std::string> cells, const MeasureKeys& measures);

/// A row of a table that has these headings: the given cells, then the values of the measures for the
/// counters in `sum`.
std::vector<std::string> row_of(std::vector<std::string> cells, const MeasureKeys& measures,
                                const CountsSum& sum);

/// A table on the terminal with a row for each sum. `cells_of` makes the first cells of a row from the sum's
/// key; `first` has the headings of these cells. The first `left_aligned` columns are aligned left.
template <class Key, class CellsOf>
std::string table(const std::map<Key, CountsSum>& sums, std::vector<std::string> first,
                  const CellsOf& cells_of, const MeasureKeys& measures, std::size_t left_aligned) {
  std::vector<std::vector<std::string>> rows{headings(std::move(first), measures)};
  for (const auto& [key, sum] : sums) rows.push_back(row_of(cells_of(key), measures, sum));
  return columns(rows, left_aligned);
}

nlohmann::ordered_json or_null(const std::optional<double>& number);

/// Adds measures of a sum of counters to an object, under their keys.
void add_measures(nlohmann::ordered_json& json, const MeasureKeys& measures, const CountsSum& sum);

/// An object with rate_measures().
nlohmann::ordered_json rates_json(const CountsSum& sum);

/// The object that rates_json() gives, with all other counters of the sum added.
nlohmann::ordered_json counts_json(const CountsSum& sum);

nlohmann::ordered_json oracle_json(const OracleCounts& counts);

/// An object with the number of all pairs ("all"), the number of pairs with each PairFate (under the name of
/// the fate), and the other counters of the Funnel.
nlohmann::ordered_json funnel_json(const Funnel& funnel);

/// Adds the oracle's "disagreements" and "mismatches_with_recorded_truth" to an object.
void add_campaign_counters(nlohmann::ordered_json& json, const Statistics& statistics);

}  // namespace nearmiss
