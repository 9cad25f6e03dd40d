#include "fuzz/scenes/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <istream>
#include <limits>
#include <set>
#include <sstream>
#include <string_view>

#include "ccd/error.hpp"
#include "corpus/query_text.hpp"

namespace nearmiss {

namespace {

std::vector<std::string> words(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> found;
  for (std::string word; in >> word;) found.push_back(word);
  return found;
}

/// The vertex of a figure's "v", "v/vt", "v//vn" or "v/vt/vn".
long figure_vertex(const std::string& word, std::string_view figure, const std::string& where) {
  long index = 0;
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, index);
  if (error != std::errc() || (rest != end && *rest != '/'))
    throw Error(fmt::format("{}: found '{}' in a {}, expected the number of a vertex", where, word, figure));
  return index;
}

Vector3<double> coordinates(const std::vector<std::string>& statement, const std::string& where) {
  if (statement.size() < 4)
    throw Error(fmt::format("{}: found {} coordinates of a vertex, expected 3", where, statement.size() - 1));
  return {parse_number(statement[1], where), parse_number(statement[2], where),
          parse_number(statement[3], where)};
}

/// The vertices of a face or polyline, counted from 1; `vertices` were defined before it.
std::vector<long> figure_vertices(const std::vector<std::string>& statement, long vertices,
                                  const std::string& where) {
  const bool is_face = statement[0] == "f";
  const std::string_view figure = is_face ? "face" : "polyline";
  const std::size_t least = is_face ? 3 : 2;
  if (statement.size() < 1 + least)
    throw Error(fmt::format("{}: found a {} of {} vertices, expected at least {}", where, figure,
                            statement.size() - 1, least));
  std::vector<long> found;
  for (std::size_t i = 1; i < statement.size(); ++i) {
    const long index = figure_vertex(statement[i], figure, where);
    if (index == 0 || index < -vertices)
      throw Error(fmt::format("{}: found vertex {} in a {}, expected 1 or more, or -{} to -1", where, index,
                              figure, vertices));
    found.push_back(index > 0 ? index : vertices + 1 + index);
  }
  return found;
}

/// What else the format has; a line that starts with another word is none of an OBJ file.
bool is_passed_over(const std::string& keyword) {
  static const std::set<std::string_view> keywords{
      "vt",     "vn",         "vp",        "cstype", "deg",      "bmat",     "step",   "p",      "curv",
      "curv2",  "surf",       "parm",      "trim",   "hole",     "scrv",     "sp",     "end",    "con",
      "g",      "s",          "mg",        "o",      "bevel",    "lod",      "usemap", "maplib", "usemtl",
      "mtllib", "shadow_obj", "ctech",     "call",   "c_interp", "d_interp", "csh",    "stech",  "bsp",
      "bzp",    "cdc",        "trace_obj", "cdp",    "res"};
  return keyword.starts_with('#') || keywords.contains(keyword);
}

}  // namespace

Mesh parse_obj(std::istream& in, const std::string& name) {
  struct Figure {
    bool is_face;
    long line;
    std::vector<long> vertices;
  };
  Mesh mesh;
  std::vector<Figure> figures;
  long number = 0;
  for (std::string line; std::getline(in, line);) {
    const std::string where = fmt::format("{}:{}", name, ++number);
    const auto statement = words(line);
    if (statement.empty()) continue;
    if (statement[0] == "v")
      mesh.points.push_back(coordinates(statement, where));
    else if (statement[0] == "f" || statement[0] == "l")
      figures.push_back({statement[0] == "f", number,
                         figure_vertices(statement, static_cast<long>(mesh.points.size()), where)});
    else if (!is_passed_over(statement[0]))
      throw Error(fmt::format("{}: found '{}', expected a line of the OBJ format", where, statement[0]));
  }
  if (mesh.points.empty())
    throw Error(fmt::format("{}: found no vertex in {} lines, expected a mesh", name, number));
  const auto vertices = static_cast<long>(mesh.points.size());
  if (vertices > std::numeric_limits<int>::max())
    throw Error(fmt::format("{}: found {} vertices, expected fewer than 2^31", name, vertices));
  for (const auto& [is_face, line, figure] : figures) {
    const long largest = *std::max_element(figure.begin(), figure.end());
    if (largest > vertices)  // a figure may come before its vertices
      throw Error(fmt::format("{}:{}: found vertex {} in a {}, expected at most {}, the number of vertices",
                              name, line, largest, is_face ? "face" : "polyline", vertices));
    const auto vertex = [&of = figure](std::size_t i) { return static_cast<int>(of[i] - 1); };
    for (std::size_t i = 1; !is_face && i < figure.size(); ++i)
      mesh.lines.push_back({vertex(i - 1), vertex(i)});
    for (std::size_t i = 2; is_face && i < figure.size(); ++i)
      mesh.triangles.push_back({vertex(0), vertex(i - 1), vertex(i)});
  }
  return mesh;
}

}  // namespace nearmiss
