// Queries as text: the one reader and writer of coordinates.
#pragma once

#include <charconv>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// The text without a leading byte order mark of UTF-8, which some editors write.
std::string_view without_byte_order_mark(std::string_view text);

/// A finite number, decimal or C hex float ("0x1.8p-3"), rounded to the nearest double. The locale has no
/// influence. Throws Error "<where>: found '...', expected a finite number".
double parse_number(std::string_view text, std::string_view where);

/// A number in the syntax of parse_number, rounded once to the nearest float. Throws Error "<where>: found
/// '...', expected a number in the range of float" for anything else, and for a number that is too large.
float parse_float(std::string_view text, std::string_view where);

/// A decimal integer without a plus sign; nothing if the text is not an integer in the range of the type.
template <class Integer>
std::optional<Integer> parse_integer(std::string_view text) {
  Integer value{};
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || rest != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Parses exactly numbers.size() numbers, separated by blanks or commas.
/// Throws Error that starts with `where`.
void parse_numbers(std::string_view line, std::span<double> numbers, std::string_view where);

/// A separation: a finite number, at least 0. Throws Error that starts with `where`.
double parse_separation(std::string_view text, std::string_view where);

/// The shortest C hex float with this value.
std::string to_hex(double value);

/// A text that is exactly this value: its shortest decimal, such as "-2" or "0.25", if that is exact, else
/// to_hex.
std::string to_exact(double value);

/// Hex floats separated by blanks: the vertices of the query at t = 0, then at t = 1 (24 numbers for vt and ee,
/// 18 for ve, 12 for vv); a separation other than 0 follows. parse_line reads it back exactly.
std::string to_line(const Query& query);

/// The numbers of to_line in decimals, for people. Two blanks separate points, and three separate t = 0 from
/// t = 1. parse_line reads it back exactly. If a decimal is not exact, a second line is to_line(query).
std::string to_readable(const Query& query);

/// A query from its coordinate_count(kind) coordinates, and perhaps its separation. Throws Error that starts
/// with `where`.
Query parse_line(Kind kind, std::string_view line, std::string_view where);

/// "vt", "ee", "vv" or "ve". Throws Error that starts with `where`.
Kind parse_kind(std::string_view text, std::string_view where);

/// The short names of the kinds whose bits are set in `sum`, separated by `between`, as in "vt, ee".
std::string names_of_kinds(int sum, std::string_view between);

/// The short names of all kinds, as in "vt, ee, vv or ve", each with `before` in front.
std::string names_of_kinds(std::string_view before = "");

}  // namespace nearmiss
