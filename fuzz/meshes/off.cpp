#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <limits>
#include <span>

#include "fuzz/meshes/lines.hpp"
#include "fuzz/meshes/plain.hpp"

namespace nearmiss {

namespace {

using Words = std::span<const std::string_view>;

/// A number of vertices, faces or edges, or of a vertex: from 0 to `largest`.
int parse_count(std::string_view word, int largest, std::string_view what, const Lines& lines) {
  int count = 0;
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, count);
  if (error != std::errc() || rest != end || count < 0 || count > largest)
    throw lines.error(shown(word), fmt::format("{} from 0 to {}", what, largest));
  return count;
}

/// The words behind the keyword; or of the next line, if there are none.
Words after_keyword(Lines& lines) {
  const bool here = lines.next();
  const std::string_view keyword = here ? lines.words()[0] : std::string_view();
  std::string_view kind = keyword;
  for (const std::string_view extra : {"ST", "C", "N"})  // what a vertex has beside its coordinates
    if (kind.starts_with(extra)) kind.remove_prefix(extra.size());
  if (kind != "OFF") throw lines.error(shown(keyword), "OFF, or with ST, C or N before it");
  if (lines.words().size() > 1) return Words(lines.words()).subspan(1);
  lines.next();
  return lines.words();
}

/// The next line of a vertex or face.
Words next_line(Lines& lines, std::string_view what, int index, int count) {
  if (!lines.next())
    throw lines.error("the end of the file", fmt::format("{} {} of {}", what, index + 1, count));
  return lines.words();
}

void expect_decimals(Words words, const Lines& lines) {
  for (const std::string_view word : words) expect_decimal(word, lines);
}

}  // namespace

std::string plain_off(std::string_view text, std::string_view name) {
  constexpr int largest = std::numeric_limits<int>::max();
  Lines lines(text, name, Lines::Comments::hash);
  const Words counts = after_keyword(lines);
  if (counts.size() != 2 && counts.size() != 3)
    throw lines.error(fmt::format("{}", fmt::join(counts, " ")), "the numbers of vertices, faces and edges");
  const int vertices = parse_count(counts[0], largest, "a number of vertices", lines);
  expect_points(static_cast<std::size_t>(vertices), name);
  const int faces = parse_count(counts[1], largest, "a number of faces", lines);
  std::string plain = fmt::format("OFF\n{} {} 0\n", vertices, faces);
  for (int i = 0; i < vertices; ++i) {
    const Words vertex = next_line(lines, "vertex", i, vertices);
    if (vertex.size() < 3) throw lines.error(fmt::format("{} coordinates of a vertex", vertex.size()), "3");
    expect_decimals(vertex, lines);
    plain += fmt::format("{}\n", fmt::join(vertex.first(3), " "));
  }
  for (int i = 0; i < faces; ++i) {
    const Words face = next_line(lines, "face", i, faces);
    const auto size = static_cast<std::size_t>(parse_count(face[0], largest, "a number of vertices", lines));
    if (size < 3) throw lines.error(fmt::format("a face of {} vertices", size), "at least 3");
    if (face.size() <= size)
      throw lines.error(fmt::format("{} vertices of a face", face.size() - 1), fmt::format("{}", size));
    for (const std::string_view word : face.subspan(1, size))
      parse_count(word, vertices - 1, "a vertex", lines);
    expect_decimals(face.subspan(1 + size), lines);  // of its colour
    plain += fmt::format("{}\n", fmt::join(face.first(1 + size), " "));
  }
  if (lines.next()) throw lines.error(shown(lines.words()[0]), "the end of the file");
  return plain;
}

}  // namespace nearmiss
