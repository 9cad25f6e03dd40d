// Formats numbers and tables as text, in the same way for all terminals and reports.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/statistics/histogram.hpp"

namespace nearmiss {

/// A table in columns. The first `left_aligned` columns are aligned left, and the other columns are aligned
/// right.
std::string columns(const std::vector<std::vector<std::string>>& rows, std::size_t left_aligned);

/// 1234567 as "1,234,567".
std::string with_separators(std::uint64_t number);

/// `part` as a percentage of `total`, such as "12.3 %"; "" if the total is 0.
std::string percent(std::uint64_t part, std::uint64_t total);

/// The number that the whole text represents; nothing if the text is not a number.
std::optional<double> number_in(std::string_view text);

/// A time in ns, rounded to a whole number; "-" if the time is not known.
std::string whole_ns(const std::optional<double>& ns);

/// A ratio distance / bound with three digits, or with more digits if three digits would round a ratio below
/// 1 to 1. The text is "below 1e-16" for a nonzero ratio in the lowest bin of a Histogram, because only an
/// upper bound of such a ratio is known. The text is "inf" for the largest double, which stands for a
/// distance divided by a bound of 0.
std::string fraction_of_bound(double ratio);

/// "at 0.987 of the bound", "at 1.5 times the bound", or "beyond a bound of 0". If the subject claims no
/// bound, the text says that the subject claims none: "at 12.3 times wang's bound (it claims none)".
std::string times_the_bound(double ratio, DistanceUnit unit = DistanceUnit::claimed_bound);

/// fraction_of_bound(ratio), with "**" if the subject claims no bound; `unit_footnote` explains the mark.
std::string marked_fraction_of_bound(double ratio, DistanceUnit unit);
inline constexpr const char* unit_footnote =
    "** in units of wang's bound for the same pair, because the subject claims no bound";

/// "1 query", "1,234 queries"
std::string counted(std::uint64_t count, std::string_view one, std::string_view many);

/// Breaks a text into lines of at most `widest` columns, at blanks where possible. Begins each line after the
/// first with `indent`, and cuts off the text that does not fit into `most_lines` lines. The default of
/// `widest` suits test frameworks, which break longer lines.
std::string wrapped(std::string text, std::string_view indent, std::size_t most_lines,
                    std::size_t widest = 79);

/// "seen once", "seen 1,234 times"
std::string seen_text(std::uint64_t times);

}  // namespace nearmiss
