#include "reports/text/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "reports/statistics/histogram.hpp"

namespace nearmiss {

std::string columns(const std::vector<std::vector<std::string>>& rows, std::size_t left_aligned) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += i < left_aligned ? fmt::format("{:<{}}  ", row[i], widths[i])
                               : fmt::format("{:>{}}  ", row[i], widths[i]);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

std::string with_separators(std::uint64_t number) {
  std::string digits = fmt::format("{}", number);
  for (auto i = static_cast<int>(digits.size()) - 3; i > 0; i -= 3)
    digits.insert(static_cast<std::size_t>(i), 1, ',');
  return digits;
}

std::string counted(std::uint64_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", with_separators(count), count == 1 ? one : many);
}

std::string percent(std::uint64_t part, std::uint64_t total) {
  return total == 0 ? ""
                    : fmt::format("{:.3g} %", 100 * static_cast<double>(part) / static_cast<double>(total));
}

std::optional<double> number_in(std::string_view text) {
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && rest == end ? std::optional(number) : std::nullopt;
}

std::string whole_ns(const std::optional<double>& ns) { return ns ? fmt::format("{:.0f}", *ns) : "-"; }

namespace {

constexpr double infinite = std::numeric_limits<double>::max();

}  // namespace

std::string fraction_of_bound(double ratio) {
  if (ratio == infinite) return "inf";
  if (ratio > 0 && Histogram::lower_border(ratio) == 0)
    return fmt::format("below {:g}", Histogram::border(1));
  std::string text;
  for (int digits = 3; digits <= 17; ++digits) {
    text = fmt::format("{:.{}g}", ratio, digits);
    if (ratio >= 1 || text != "1") break;
  }
  return text;
}

std::string times_the_bound(double ratio, DistanceUnit unit) {
  const bool is_claim = unit == DistanceUnit::claimed_bound;
  std::string text = ratio == infinite ? fmt::format("beyond {} bound of 0", is_claim ? "a" : "wang's")
                                       : fmt::format("at {} {} bound", fraction_of_bound(ratio),
                                                     !is_claim    ? "times wang's"
                                                     : ratio <= 1 ? "of the"
                                                                  : "times the");
  if (unit == DistanceUnit::wangs_bound) text += " (it claims none)";
  if (unit == DistanceUnit::both) text += " or a claim";
  return text;
}

std::string marked_fraction_of_bound(double ratio, DistanceUnit unit) {
  return fraction_of_bound(ratio) + (unit == DistanceUnit::claimed_bound ? "" : "**");
}

std::string wrapped(std::string text, std::string_view indent, std::size_t most_lines, std::size_t widest) {
  std::string lines;
  for (std::size_t line = 1; line <= most_lines; ++line) {
    if (text.size() <= widest) return lines + text + "\n";
    const std::size_t limit = widest - (line == most_lines ? 4 : 0);  // " ..."
    const std::size_t blank = text.rfind(' ', limit);
    const bool has_blank = blank != std::string::npos && blank > indent.size();
    const std::size_t end = has_blank ? blank : limit;
    lines += text.substr(0, end) + (line == most_lines ? " ...\n" : "\n");
    text = std::string(indent) + text.substr(end + (has_blank ? 1 : 0));
  }
  return lines;
}

std::string seen_text(std::uint64_t times) {
  return times == 1 ? "seen once" : fmt::format("seen {} times", with_separators(times));
}

}  // namespace nearmiss
