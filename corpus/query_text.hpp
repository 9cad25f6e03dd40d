// Reads and writes queries, and the numbers in them, as text.
#pragma once

#include <charconv>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// A text without the byte order mark of UTF-8 that some editors write at the beginning.
std::string_view without_byte_order_mark(std::string_view text);

/// Parses a finite number, which is a decimal or a C hex float ("0x1.8p-3"), and rounds it to the nearest
/// double. Throws Error "<where>: found '...', expected a finite number" for any other text.
double parse_number(std::string_view text, std::string_view where);

/// Parses a number in the syntax of parse_number, and rounds it directly to the nearest float. Throws Error
/// "<where>: found '...', expected a number in the range of float" for any other text, and for a number that
/// is too large.
float parse_float(std::string_view text, std::string_view where);

/// Parses a decimal integer without a plus sign. Returns nothing if the text is not an integer in the range
/// of `Integer`.
template <class Integer>
std::optional<Integer> parse_integer(std::string_view text) {
  Integer value{};
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || rest != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Parses exactly numbers.size() numbers, separated by blanks or commas. Throws an Error that starts with
/// `where`.
void parse_numbers(std::string_view line, std::span<double> numbers, std::string_view where);

/// Parses a separation: a finite number that is at least 0. Throws an Error that starts with `where`.
double parse_separation(std::string_view text, std::string_view where);

/// The shortest C hex float with this value.
std::string to_hex(double value);

/// The shortest decimal that parse_number() rounds to this value, such as "-2" or "0.25", if this decimal
/// equals the value exactly; otherwise, to_hex(value).
std::string to_exact(double value);

/// A query as hex floats separated by blanks: the vertices at t = 0, then at t = 1 (24 numbers for vt and ee,
/// 18 for ve, 12 for vv). If the separation is not 0, it follows as the last number. parse_line() reads the
/// query back exactly.
std::string to_line(const Query& query);

/// A query in a form for people: the numbers of to_line() in decimals. Two blanks separate points. Three
/// blanks separate the points at t = 0, the points at t = 1, and the separation. parse_line() reads the query
/// back exactly. If a decimal does not equal its number exactly, to_line(query) follows as a second line.
std::string to_readable(const Query& query);

/// Parses a query: coordinate_count(kind) coordinates, which a separation may follow. Throws an Error that
/// starts with `where`.
Query parse_line(Kind kind, std::string_view line, std::string_view where);

/// Parses the short name of a kind: "vt", "ee", "vv" or "ve". Throws an Error that starts with `where`.
Kind parse_kind(std::string_view text, std::string_view where);

/// The short names of the kinds whose bits are set in `sum`, separated by `between`, as in "vt, ee".
std::string names_of_kinds(int sum, std::string_view between);

/// The short names of all kinds, as in "vt, ee, vv or ve", each with `before` in front.
std::string names_of_kinds(std::string_view before = "");

}  // namespace nearmiss
