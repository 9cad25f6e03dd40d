#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>
#include <string_view>

#include "corpus/query_text.hpp"
#include "fuzz/meshes/formats.hpp"
#include "fuzz/meshes/lines.hpp"

namespace nearmiss {

namespace {

struct FaceOrPolyline {
  bool is_face;
  long line;
  /// The range of this primitive's vertices in the list of the vertices of all primitives.
  std::size_t begin, end;
};

std::string_view name_of(bool is_face) { return is_face ? "face" : "polyline"; }

/// The number of a vertex as the file has it, which is v in "v", "v/vt", "v//vn" or "v/vt/vn".
long parse_vertex(std::string_view word, bool is_face, const Lines& lines) {
  const auto vertex = parse_integer<long>(word.substr(0, word.find('/')));
  if (!vertex)
    throw lines.error(fmt::format("{} in a {}", shown(word), name_of(is_face)), "the number of a vertex");
  return *vertex;
}

Vector3<double> coordinates(const Lines& lines) {
  const auto& words = lines.words();
  if (words.size() < 4) throw lines.error(fmt::format("{} coordinates of a vertex", words.size() - 1), "3");
  const std::string where = lines.where();
  return {parse_number(words[1], where), parse_number(words[2], where), parse_number(words[3], where)};
}

/// Adds the indices of a face's or polyline's vertices to a list; the indices count from 0. `points` is the
/// number of points that are defined before this line.
void add_vertices(const Lines& lines, bool is_face, long points, std::vector<long>& list) {
  const auto& words = lines.words();
  const std::size_t least = is_face ? 3 : 2;
  if (words.size() < 1 + least)
    throw lines.error(fmt::format("a {} of {} vertices", name_of(is_face), words.size() - 1),
                      fmt::format("at least {}", least));
  for (std::size_t i = 1; i < words.size(); ++i) {
    const long vertex = parse_vertex(words[i], is_face, lines);
    if (vertex == 0 || vertex < -points)
      throw lines.error(fmt::format("vertex {} in a {}", vertex, name_of(is_face)),
                        fmt::format("1 or more, or -{} to -1", points));
    list.push_back(vertex > 0 ? vertex - 1 : points + vertex);
  }
}

void add_polyline(Mesh& mesh, std::span<const long> polyline) {
  for (std::size_t i = 1; i < polyline.size(); ++i)
    mesh.lines.push_back({static_cast<int>(polyline[i - 1]), static_cast<int>(polyline[i])});
}

/// Adds the triangles and lines. Throws Error if a vertex of a primitive does not exist. Only at the end of
/// the file is it known which vertices exist, since faces may come before their vertices.
void add_primitives(Mesh& mesh, const std::vector<FaceOrPolyline>& primitives, std::span<const long> vertices,
                    const Lines& lines) {
  const auto points = static_cast<long>(mesh.points.size());
  for (const auto& [is_face, line, begin, end] : primitives) {
    const std::span primitive = vertices.subspan(begin, end - begin);
    const long largest = *std::max_element(primitive.begin(), primitive.end());
    if (largest >= points)
      throw Error(fmt::format("{}: found vertex {} in a {}, expected at most {}, the number of vertices",
                              lines.where(line), largest + 1, name_of(is_face), points));
    if (is_face)
      add_polygon(mesh, primitive);
    else
      add_polyline(mesh, primitive);
  }
}

/// Whether a line with this first word is valid in the format, but not needed for a mesh.
bool is_skipped(std::string_view keyword) {
  static const std::set<std::string_view> keywords{
      "vt",     "vn",         "vp",        "cstype", "deg",      "bmat",     "step",   "p",      "curv",
      "curv2",  "surf",       "parm",      "trim",   "hole",     "scrv",     "sp",     "end",    "con",
      "g",      "s",          "mg",        "o",      "bevel",    "lod",      "usemap", "maplib", "usemtl",
      "mtllib", "shadow_obj", "ctech",     "call",   "c_interp", "d_interp", "csh",    "stech",  "bsp",
      "bzp",    "cdc",        "trace_obj", "cdp",    "res"};
  return keywords.contains(keyword);
}

}  // namespace

Mesh parse_obj(std::string_view text, const std::string& name) {
  Lines lines(text, name, Lines::Comments::hash, Lines::Continuation::backslash);
  Mesh mesh;
  std::vector<FaceOrPolyline> primitives;
  std::vector<long> vertices;
  while (lines.next()) {
    const std::string_view keyword = lines.words()[0];
    if (keyword == "v") {
      mesh.points.push_back(coordinates(lines));
    } else if (keyword == "f" || keyword == "l") {
      const std::size_t begin = vertices.size();
      add_vertices(lines, keyword == "f", static_cast<long>(mesh.points.size()), vertices);
      primitives.push_back({keyword == "f", lines.number(), begin, vertices.size()});
    } else if (!is_skipped(keyword)) {
      throw lines.error(shown(keyword), "a line of the OBJ format");
    }
  }
  expect_points(mesh.points.size(), name);
  add_primitives(mesh, primitives, vertices, lines);
  return mesh;
}

}  // namespace nearmiss
