#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <span>
#include <string_view>

#include "corpus/query_text.hpp"
#include "fuzz/meshes/lines.hpp"
#include "fuzz/meshes/mesh.hpp"

namespace nearmiss {

namespace {

/// A face or polyline; its vertices count from 1.
struct Primitive {
  bool is_face;
  long line;
  std::size_t begin, end;  ///< of its vertices, in the list of all primitives' vertices
};

std::string_view name_of(bool is_face) { return is_face ? "face" : "polyline"; }

/// The vertex of a primitive's "v", "v/vt", "v//vn" or "v/vt/vn".
long primitive_vertex(std::string_view word, bool is_face, const Lines& lines) {
  long index = 0;
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, index);
  if (error != std::errc() || (rest != end && *rest != '/'))
    throw lines.error(fmt::format("{} in a {}", shown(word), name_of(is_face)), "the number of a vertex");
  return index;
}

Vector3<double> coordinates(const Lines& lines) {
  const auto& words = lines.words();
  if (words.size() < 4) throw lines.error(fmt::format("{} coordinates of a vertex", words.size() - 1), "3");
  const std::string where = lines.where();
  return {parse_number(words[1], where), parse_number(words[2], where), parse_number(words[3], where)};
}

/// Adds the vertices of a face or polyline, counted from 1, to a list; `points` were defined before it.
void add_primitive_vertices(const Lines& lines, bool is_face, long points, std::vector<long>& list) {
  const auto& words = lines.words();
  const std::size_t least = is_face ? 3 : 2;
  if (words.size() < 1 + least)
    throw lines.error(fmt::format("a {} of {} vertices", name_of(is_face), words.size() - 1),
                      fmt::format("at least {}", least));
  for (std::size_t i = 1; i < words.size(); ++i) {
    const long index = primitive_vertex(words[i], is_face, lines);
    if (index == 0 || index < -points)
      throw lines.error(fmt::format("vertex {} in a {}", index, name_of(is_face)),
                        fmt::format("1 or more, or -{} to -1", points));
    list.push_back(index > 0 ? index : points + 1 + index);
  }
}

/// Adds the triangles of a face or the lines of a polyline.
void add_primitive(bool is_face, std::span<const long> primitive, Mesh& mesh) {
  const auto vertex = [&](std::size_t i) { return static_cast<int>(primitive[i] - 1); };
  for (std::size_t i = 1; !is_face && i < primitive.size(); ++i)
    mesh.lines.push_back({vertex(i - 1), vertex(i)});
  for (std::size_t i = 2; is_face && i < primitive.size(); ++i)
    mesh.triangles.push_back({vertex(0), vertex(i - 1), vertex(i)});
}

/// What else the format has; a line that starts with another word is none of an OBJ file.
bool is_passed_over(std::string_view keyword) {
  static const std::set<std::string_view> keywords{
      "vt",     "vn",         "vp",        "cstype", "deg",      "bmat",     "step",   "p",      "curv",
      "curv2",  "surf",       "parm",      "trim",   "hole",     "scrv",     "sp",     "end",    "con",
      "g",      "s",          "mg",        "o",      "bevel",    "lod",      "usemap", "maplib", "usemtl",
      "mtllib", "shadow_obj", "ctech",     "call",   "c_interp", "d_interp", "csh",    "stech",  "bsp",
      "bzp",    "cdc",        "trace_obj", "cdp",    "res"};
  return keywords.contains(keyword);
}

}  // namespace

Mesh parse_obj(std::istream& in, const std::string& name) {
  const std::string text = read_all(in, name);
  Lines lines(text, name, Lines::Comments::hash);
  Mesh mesh;
  std::vector<Primitive> primitives;
  std::vector<long> vertices;
  while (lines.next()) {
    const std::string_view keyword = lines.words()[0];
    if (keyword == "v") {
      mesh.points.push_back(coordinates(lines));
    } else if (keyword == "f" || keyword == "l") {
      const std::size_t begin = vertices.size();
      add_primitive_vertices(lines, keyword == "f", static_cast<long>(mesh.points.size()), vertices);
      primitives.push_back({keyword == "f", lines.number(), begin, vertices.size()});
    } else if (!is_passed_over(keyword)) {
      throw lines.error(shown(keyword), "a line of the OBJ format");
    }
  }
  expect_points(mesh.points.size(), name);
  const auto points = static_cast<long>(mesh.points.size());
  for (const auto& [is_face, line, begin, end] : primitives) {
    const std::span primitive = std::span(vertices).subspan(begin, end - begin);
    const long largest = *std::max_element(primitive.begin(), primitive.end());
    if (largest > points)  // a primitive may come before its vertices
      throw Error(fmt::format("{}: found vertex {} in a {}, expected at most {}, the number of vertices",
                              lines.where(line), largest, name_of(is_face), points));
    add_primitive(is_face, primitive, mesh);
  }
  return mesh;
}

}  // namespace nearmiss
