#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>

#include "corpus/query_text.hpp"
#include "fuzz/meshes/formats.hpp"
#include "fuzz/meshes/lines.hpp"

namespace nearmiss {

namespace {

/// Builds a mesh of triangles that are given by three points each. Equal points become one point.
class TriangleSoup {
 public:
  using Corner = std::array<double, 3>;

  void add(const std::array<Corner, 3>& triangle) {
    mesh_.triangles.push_back({point(triangle[0]), point(triangle[1]), point(triangle[2])});
  }
  [[nodiscard]] Mesh mesh(std::string_view name) && {
    expect_points(mesh_.points.size(), name);
    return std::move(mesh_);
  }

 private:
  int point(const Corner& corner) {
    const auto [found, is_new] = points_.try_emplace(corner, static_cast<int>(mesh_.points.size()));
    if (is_new) mesh_.points.emplace_back(corner[0], corner[1], corner[2]);
    return found->second;
  }

  Mesh mesh_;
  std::map<Corner, int> points_;  // 0 and -0 are equal here
};

// --- text -------------------------------------------------------------------------------------------------

void expect_words(Lines& lines, std::initializer_list<std::string_view> expected) {
  for (const std::string_view word : expected) {
    const std::string_view found = lines.next_word();
    if (lower_case(found) != word) throw lines.error(shown(found), fmt::format("'{}'", word));
  }
}

double read_coordinate(Lines& lines) {
  const std::string_view word = lines.next_word();
  if (word.empty()) throw lines.error(shown(word), "a coordinate");
  return parse_decimal(word, lines);
}

/// Reads the rest of a facet after the word "facet". The normal may be any three words, because some
/// exporters write nan in the normal of a degenerate facet.
std::array<TriangleSoup::Corner, 3> read_facet(Lines& lines) {
  expect_words(lines, {"normal"});
  for (int i = 0; i < 3; ++i) lines.next_word();
  expect_words(lines, {"outer", "loop"});
  std::array<TriangleSoup::Corner, 3> triangle{};
  for (auto& corner : triangle) {
    expect_words(lines, {"vertex"});
    for (double& c : corner) c = read_coordinate(lines);
  }
  expect_words(lines, {"endloop", "endfacet"});
  return triangle;
}

Mesh parse_text(std::string_view text, std::string_view name) {
  Lines lines(text, name, Lines::Comments::none);
  TriangleSoup soup;
  while (lines.next()) {  // several solids become one mesh
    expect_words(lines, {"solid"});
    lines.skip_line();  // the name of the solid
    std::string_view word = lines.next_word();
    for (; lower_case(word) == "facet"; word = lines.next_word()) soup.add(read_facet(lines));
    if (lower_case(word) != "endsolid") throw lines.error(shown(word), "'facet' or 'endsolid'");
  }
  return std::move(soup).mesh(name);
}

// --- bytes ------------------------------------------------------------------------------------------------

constexpr std::size_t header_bytes = 80;
/// The bytes of a facet: its normal and its three vertices, with three floats each, and two further bytes.
constexpr std::size_t facet_bytes = 50;

/// The size that a binary file has according to its header.
std::size_t promised_size(std::string_view bytes) {
  std::uint32_t facets = 0;
  if (bytes.size() < header_bytes + sizeof facets) return header_bytes + sizeof facets;
  std::memcpy(&facets, bytes.data() + header_bytes, sizeof facets);
  return header_bytes + sizeof facets + facets * facet_bytes;
}

Mesh parse_binary(std::string_view bytes, std::string_view name) {
  if (bytes.size() != promised_size(bytes))
    throw Error(
        fmt::format("{}: found {} bytes, expected {} of a binary STL file, or text that starts with 'solid'",
                    name, bytes.size(), promised_size(bytes)));
  TriangleSoup soup;
  const std::string_view facets = bytes.substr(header_bytes + sizeof(std::uint32_t));
  for (std::size_t at = 0; at < facets.size(); at += facet_bytes) {
    std::array<float, 12> numbers{};
    std::memcpy(numbers.data(), facets.data() + at, sizeof numbers);
    const auto bad =
        std::find_if(numbers.begin() + 3, numbers.end(), [](float c) { return !std::isfinite(c); });
    if (bad != numbers.end())
      throw Error(fmt::format("{}: found {} in facet {}, expected a finite number", name, *bad,
                              at / facet_bytes + 1));
    std::array<TriangleSoup::Corner, 3> triangle{};
    for (std::size_t i = 0; i < 9; ++i) triangle[i / 3][i % 3] = numbers[3 + i];
    soup.add(triangle);
  }
  return std::move(soup).mesh(name);
}

}  // namespace

Mesh parse_stl(std::string_view text, const std::string& name) {
  const std::string_view words = without_byte_order_mark(text);
  const std::size_t start = std::min(words.find_first_not_of(" \t\r\n"), words.size());
  const bool is_text = lower_case(words.substr(start, 5)) == "solid" && text.size() != promised_size(text);
  return is_text ? parse_text(text, name) : parse_binary(text, name);
}

}  // namespace nearmiss
