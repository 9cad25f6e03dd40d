#include "reports/text/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

/// The number that a text of digits denotes; nothing if the text has other characters, or if the number
/// exceeds 64 bits.
std::optional<std::uint64_t> digits(std::string_view text) {
  std::uint64_t value = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || rest != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The number that a text DIGITS or DIGITSeDIGITS denotes; nothing for any other text.
std::optional<std::uint64_t> count(std::string_view text) {
  const std::size_t e = text.find_first_of("eE");
  auto value = digits(text.substr(0, e));
  if (e == std::string_view::npos || !value) return value;
  const auto zeros = digits(text.substr(e + 1));
  constexpr std::uint64_t most_zeros = 19;
  if (!zeros || *zeros > most_zeros) return std::nullopt;
  for (std::uint64_t i = 0; i < *zeros; ++i)
    if (__builtin_mul_overflow(*value, std::uint64_t{10}, &*value)) return std::nullopt;
  return value;
}

}  // namespace

std::uint64_t parse_count(std::string_view text, std::string_view option, std::uint64_t least,
                          std::uint64_t most) {
  const auto value = count(text);
  if (!value || *value < least || *value > most)
    throw Error(fmt::format("{}: found '{}', expected a whole number from {} to {}", option, excerpt(text),
                            least, most));
  return *value;
}

std::chrono::duration<double> parse_duration(std::string_view text, std::string_view option) {
  double number = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string_view unit(rest, static_cast<std::size_t>(text.data() + text.size() - rest));
  const double seconds = unit == "ms" ? 1e-3 : unit == "s" ? 1 : unit == "m" ? 60 : unit == "h" ? 3600 : 0;
  if (error != std::errc() || seconds == 0 || !(number > 0) || !(number * seconds <= 1e9))
    throw Error(
        fmt::format("{}: found '{}', expected a time such as 500ms, 30s, 2m or 8h", option, excerpt(text)));
  return std::chrono::duration<double>(number * seconds);
}

std::uint64_t parse_size(std::string_view text, std::string_view option) {
  constexpr std::string_view units = "KMGTP";
  constexpr int bits_of_unit = 10;
  const std::size_t end = std::min(text.find_first_not_of("0123456789"), text.size());
  const auto number = digits(text.substr(0, end));
  const std::string_view unit = text.substr(end);
  // If the unit is unknown, `power` is 0, too.
  const std::size_t power = unit.empty() ? 0 : units.find(unit.front()) + 1;
  const std::string_view rest = unit.substr(std::min<std::size_t>(unit.size(), power == 0 ? 0 : 1));
  const bool is_unit = rest.empty() || rest == "B" || (power != 0 && rest == "iB");
  const std::size_t shift = bits_of_unit * power;
  if (!number || !is_unit || *number << shift >> shift != *number)
    throw Error(
        fmt::format("{}: found '{}', expected a number of bytes such as 512M or 1G, or 0 for no limit",
                    option, excerpt(text)));
  return *number << shift;
}

double parse_positive(std::string_view text, std::string_view option) {
  const auto number = number_in(text);
  if (!number || !(*number > 0) || !std::isfinite(*number))
    throw Error(fmt::format("{}: found '{}', expected a positive number", option, excerpt(text)));
  return *number;
}

}  // namespace nearmiss
