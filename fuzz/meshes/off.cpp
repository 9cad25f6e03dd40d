#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <span>

#include "ccd/query/excerpt.hpp"
#include "corpus/query_text.hpp"
#include "fuzz/meshes/formats.hpp"
#include "fuzz/meshes/lines.hpp"

namespace nearmiss {

namespace {

using Words = std::span<const std::string_view>;

constexpr int largest_int = std::numeric_limits<int>::max();

/// Parses a number of vertices or faces, or the index of a vertex. Throws Error unless the result is from 0
/// to `largest`.
int parse_count(std::string_view word, int largest, std::string_view what, const Lines& lines) {
  const auto count = parse_integer<int>(word);
  if (!count || *count < 0 || *count > largest)
    throw lines.error(shown(word), fmt::format("{} from 0 to {}", what, largest));
  return *count;
}

/// The words that follow the keyword OFF on its line. If the line of the keyword has no more words, returns
/// the words of the next line.
Words after_keyword(Lines& lines) {
  const bool here = lines.next();
  const std::string_view keyword = here ? lines.words()[0] : std::string_view();
  std::string_view kind = keyword;
  // Each of these prefixes of OFF announces that every vertex has further data.
  for (const std::string_view extra : {"ST", "C", "N"})
    if (kind.starts_with(extra)) kind.remove_prefix(extra.size());
  if (kind != "OFF") throw lines.error(shown(keyword), "OFF, or with ST, C or N before it");
  if (lines.words().size() > 1) return Words(lines.words()).subspan(1);
  lines.next();
  return lines.words();
}

struct MeshSize {
  int vertices, faces;
};

MeshSize read_size(Lines& lines, std::string_view name) {
  const Words counts = after_keyword(lines);
  if (counts.size() != 2 && counts.size() != 3)
    throw lines.error(excerpt(fmt::format("{}", fmt::join(counts, " "))),
                      "the numbers of vertices, faces and edges");
  const int vertices = parse_count(counts[0], largest_int, "a number of vertices", lines);
  expect_points(static_cast<std::size_t>(vertices), name);
  return {vertices, parse_count(counts[1], largest_int, "a number of faces", lines)};
}

/// Returns the words of the next line, which has a vertex or face. `index` is the number of this vertex or
/// face, counted from 0, and `count` is the number of all vertices or faces. Throws Error if there is no
/// further line.
Words next_line(Lines& lines, std::string_view what, int index, int count) {
  if (!lines.next())
    throw lines.error("the end of the file", fmt::format("{} {} of {}", what, index + 1, count));
  return lines.words();
}

/// Throws Error unless all words are finite numbers; a mesh does not need their values.
void expect_decimals(Words words, const Lines& lines) {
  for (const std::string_view word : words) parse_decimal(word, lines);
}

Vector3<double> parse_vertex(Words vertex, const Lines& lines) {
  if (vertex.size() < 3) throw lines.error(fmt::format("{} coordinates of a vertex", vertex.size()), "3");
  Vector3<double> point;
  for (int i = 0; i < 3; ++i) point[i] = parse_decimal(vertex[static_cast<std::size_t>(i)], lines);
  expect_decimals(vertex.subspan(3), lines);
  return point;
}

/// The vertices of a face.
std::vector<long> parse_face(Words face, int vertices, const Lines& lines) {
  const auto size =
      static_cast<std::size_t>(parse_count(face[0], largest_int, "a number of vertices", lines));
  if (size < 3) throw lines.error(fmt::format("a face of {} vertices", size), "at least 3");
  if (face.size() <= size)
    throw lines.error(fmt::format("{} vertices of a face", face.size() - 1), fmt::format("{}", size));
  std::vector<long> polygon;
  for (const std::string_view word : face.subspan(1, size))
    polygon.push_back(parse_count(word, vertices - 1, "a vertex", lines));
  expect_decimals(face.subspan(1 + size), lines);  // the colour
  return polygon;
}

}  // namespace

Mesh parse_off(std::string_view text, const std::string& name) {
  Lines lines(text, name, Lines::Comments::hash);
  const MeshSize size = read_size(lines, name);
  Mesh mesh;
  for (int i = 0; i < size.vertices; ++i)
    mesh.points.push_back(parse_vertex(next_line(lines, "vertex", i, size.vertices), lines));
  for (int i = 0; i < size.faces; ++i)
    add_polygon(mesh, parse_face(next_line(lines, "face", i, size.faces), size.vertices, lines));
  if (lines.next()) throw lines.error(shown(lines.words()[0]), "the end of the file");
  return mesh;
}

}  // namespace nearmiss
