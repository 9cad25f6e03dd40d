#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "fuzz/meshes/lines.hpp"
#include "fuzz/meshes/plain.hpp"

namespace nearmiss {

namespace {

std::string lower_case(std::string_view word) {
  std::string lower(word);
  std::transform(word.begin(), word.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

void expect_words(Lines& lines, std::initializer_list<std::string_view> expected) {
  for (const std::string_view word : expected) {
    const std::string_view found = lines.next_word();
    if (lower_case(found) != word) throw lines.error(shown(found), fmt::format("'{}'", word));
  }
}

/// A facet behind the word "facet". The normal may be anything: exporters write nan for a degenerate one.
void add_facet(Lines& lines, std::string& plain) {
  expect_words(lines, {"normal"});
  for (int i = 0; i < 3; ++i) lines.next_word();
  expect_words(lines, {"outer", "loop"});
  plain += "facet\n";
  for (int i = 0; i < 3; ++i) {
    expect_words(lines, {"vertex"});
    plain += "vertex";
    for (int j = 0; j < 3; ++j) {
      const std::string_view coordinate = lines.next_word();
      if (coordinate.empty()) throw lines.error(shown(coordinate), "a coordinate");
      expect_decimal(coordinate, lines);
      plain.append(" ").append(coordinate);
    }
    plain += '\n';
  }
  plain += "endfacet\n";
  expect_words(lines, {"endloop", "endfacet"});
}

std::string plain_text(std::string_view text, std::string_view name) {
  Lines lines(text, name, Lines::Comments::none);
  std::string plain = "solid\n";
  while (lines.next()) {  // several solids become one
    expect_words(lines, {"solid"});
    lines.skip_line();  // its name
    std::string_view word = lines.next_word();
    for (; lower_case(word) == "facet"; word = lines.next_word()) add_facet(lines, plain);
    if (lower_case(word) != "endsolid") throw lines.error(shown(word), "'facet' or 'endsolid'");
  }
  return plain + "endsolid\n";
}

constexpr std::size_t header = 80;
constexpr std::size_t facet = 50;  ///< normal, three vertices, each of three floats; two bytes

/// How many bytes a binary file has that starts like this.
std::size_t promised_size(std::string_view bytes) {
  std::uint32_t facets = 0;
  if (bytes.size() < header + sizeof facets) return header + sizeof facets;
  std::memcpy(&facets, bytes.data() + header, sizeof facets);
  return header + sizeof facets + facets * facet;
}

std::string plain_binary(std::string_view bytes, std::string_view name) {
  if (bytes.size() != promised_size(bytes))
    throw Error(
        fmt::format("{}: found {} bytes, expected {} of a binary STL file, or text that starts with 'solid'",
                    name, bytes.size(), promised_size(bytes)));
  for (std::size_t at = header + 4; at < bytes.size(); at += facet) {
    std::array<float, 12> numbers{};
    std::memcpy(numbers.data(), bytes.data() + at, sizeof numbers);
    const auto bad =
        std::find_if(numbers.begin() + 3, numbers.end(), [](float c) { return !std::isfinite(c); });
    if (bad != numbers.end())
      throw Error(fmt::format("{}: found {} in facet {}, expected a finite number", name, *bad,
                              (at - header - 4) / facet + 1));
  }
  return std::string(header, '\0').append(bytes.substr(header));
}

}  // namespace

std::string plain_stl(std::string_view text, std::string_view name) {
  const std::string_view start = text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  const bool is_text = lower_case(start.substr(0, 5)) == "solid" && text.size() != promised_size(text);
  return is_text ? plain_text(text, name) : plain_binary(text, name);
}

}  // namespace nearmiss
