#include "corpus/query_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <type_traits>
#include <vector>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"

namespace nearmiss {

namespace {

constexpr std::string_view separators = " \t\r,";

/// Removes the first word from `rest`, and returns this word, or "" if no word is left.
std::string_view next_word(std::string_view& rest) {
  const auto first = rest.find_first_not_of(separators);
  if (first == std::string_view::npos) return rest = {};
  rest.remove_prefix(first);
  const auto word = rest.substr(0, rest.find_first_of(separators));
  rest.remove_prefix(word.size());
  return word;
}

/// Parses a finite double or float. For any other text, throws Error with `where` and `expected`.
template <class Number>
Number parse(std::string_view text, std::string_view where, std::string_view expected) {
  const auto fail = [&] {
    return Error(fmt::format("{}: found '{}', expected {}", where, excerpt(text), expected));
  };
  std::string_view digits = text;
  const bool negative = digits.starts_with('-');
  if (negative || digits.starts_with('+')) digits.remove_prefix(1);
  const bool hex = digits.starts_with("0x") || digits.starts_with("0X");
  if (hex) digits.remove_prefix(2);
  // from_chars would also accept a second sign, "inf" and "nan".
  if (digits.find_first_of(".0123456789abcdefABCDEF") != 0) throw fail();
  Number value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value,
                                            hex ? std::chars_format::hex : std::chars_format::general);
  if (end != digits.data() + digits.size()) throw fail();
  if (error == std::errc::result_out_of_range) {
    // The number is too large, or so small that it rounds to 0. Only a number that is too large is an error.
    // strtod and strtof distinguish the two cases.
    const std::string again = std::string(hex ? "0x" : "").append(digits);
    if constexpr (std::is_same_v<Number, float>)
      value = std::strtof(again.c_str(), nullptr);
    else
      value = std::strtod(again.c_str(), nullptr);
  } else if (error != std::errc()) {
    throw fail();
  }
  if (!std::isfinite(value)) throw fail();
  return negative ? -value : value;
}

/// The number of digits of a number in scientific notation; trailing zeros do not count.
std::size_t significant_digits(std::string_view scientific) {
  const std::string_view significand = scientific.substr(0, scientific.find('e'));
  const std::string_view kept = significand.substr(0, significand.find_last_not_of(".0") + 1);
  return static_cast<std::size_t>(
      std::count_if(kept.begin(), kept.end(), [](char c) { return c >= '0' && c <= '9'; }));
}

/// Whether the shortest decimal that rounds to this value equals the value exactly. Among all decimals with
/// the same number of digits, the shortest decimal is the nearest to the value. So the shortest decimal is
/// exact if it has as many digits as the exact decimal of the value.
bool has_exact_decimal(double value) {
  constexpr int most_digits = 767;  // the exact decimal of a double has at most this number of digits
  std::array<char, most_digits + 10> text;
  const auto shortest = std::to_chars(text.begin(), text.end(), value, std::chars_format::scientific);
  const std::size_t digits = significant_digits({text.data(), shortest.ptr});
  const auto full =
      std::to_chars(text.begin(), text.end(), value, std::chars_format::scientific, most_digits - 1);
  return significant_digits({text.data(), full.ptr}) == digits;
}

}  // namespace

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

double parse_number(std::string_view text, std::string_view where) {
  return parse<double>(text, where, "a finite number");
}

float parse_float(std::string_view text, std::string_view where) {
  return parse<float>(text, where, "a number in the range of float");
}

namespace {

/// Parses the first words of a line into `numbers`. Returns the number of words in the line.
std::size_t parse_words(std::string_view line, std::span<double> numbers, std::string_view where) {
  std::size_t count = 0;
  for (auto word = next_word(line); !word.empty(); word = next_word(line), ++count)
    if (count < numbers.size()) numbers[count] = parse_number(word, where);
  return count;
}

double checked_separation(double separation, std::string_view where) {
  if (separation >= 0) return separation + 0.0;  // turns -0 into 0
  throw Error(
      fmt::format("{}: found the separation {}, expected a number that is not negative", where, separation));
}

}  // namespace

void parse_numbers(std::string_view line, std::span<double> numbers, std::string_view where) {
  if (const std::size_t count = parse_words(line, numbers, where); count != numbers.size())
    throw Error(fmt::format("{}: found {} numbers, expected {}", where, count, numbers.size()));
}

double parse_separation(std::string_view text, std::string_view where) {
  return checked_separation(parse_number(text, where), where);
}

std::string to_hex(double value) {
  if (value == 0) return std::signbit(value) ? "-0x0p+0" : "0x0p+0";
  return fmt::format("{:a}", value);
}

std::string to_exact(double value) {
  return has_exact_decimal(value) ? fmt::format("{}", value) : to_hex(value);
}

std::string to_line(const Query& query) {
  std::string line;
  for (const double c : coordinate_list(query)) {
    if (!line.empty()) line += ' ';
    line += to_hex(c);
  }
  return query.separation == 0 ? line : line + ' ' + to_hex(query.separation);
}

std::string to_readable(const Query& query) {
  std::string text;
  const std::vector<double> coordinates = coordinate_list(query);
  for (std::size_t i = 0; i < coordinates.size(); ++i)
    fmt::format_to(std::back_inserter(text), "{}{}",
                   i == 0                        ? ""
                   : i == coordinates.size() / 2 ? "   "
                   : i % 3 == 0                  ? "  "
                                                 : " ",
                   coordinates[i]);
  if (query.separation != 0) text += fmt::format("   {}", query.separation);
  const bool exact =
      std::ranges::all_of(coordinates, has_exact_decimal) && has_exact_decimal(query.separation);
  return exact ? text : fmt::format("{}\n{}", text, to_line(query));
}

Query parse_line(Kind kind, std::string_view line, std::string_view where) {
  std::array<double, 25> numbers{};
  const std::size_t count = parse_words(line, numbers, where);
  const std::size_t expected = coordinate_count(kind);
  if (count != expected && count != expected + 1)
    throw Error(fmt::format("{}: found {} numbers, expected {}, or {} with a separation", where, count,
                            expected, expected + 1));
  Query query = query_of(kind, numbers.data());
  query.separation = checked_separation(count == expected ? 0 : numbers[expected], where);
  return query;
}

Kind parse_kind(std::string_view text, std::string_view where) {
  for (const Kind kind : kinds)
    if (text == short_name(kind)) return kind;
  throw Error(fmt::format("{}: found kind '{}', expected {}", where, excerpt(text), names_of_kinds()));
}

std::string names_of_kinds(int sum, std::string_view between) {
  std::vector<std::string_view> names;
  for (const Kind kind : kinds)
    if ((sum & bit_of(kind)) != 0) names.push_back(short_name(kind));
  return fmt::format("{}", fmt::join(names, between));
}

std::string names_of_kinds(std::string_view before) {
  std::string names;
  for (const Kind kind : kinds)
    names += fmt::format("{}{}{}",
                         kind == kinds.front()  ? ""
                         : kind == kinds.back() ? " or "
                                                : ", ",
                         before, short_name(kind));
  return names;
}

}  // namespace nearmiss
