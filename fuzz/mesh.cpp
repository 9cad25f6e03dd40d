#include "fuzz/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <string_view>

#include "ccd/error.hpp"
#include "corpus/query_text.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> words(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> found;
  for (std::string word; in >> word;) found.push_back(word);
  return found;
}

/// The vertex of a face's "v", "v/vt", "v//vn" or "v/vt/vn".
long face_vertex(const std::string& word, const std::string& where) {
  long index = 0;
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, index);
  if (error != std::errc() || (rest != end && *rest != '/'))
    throw Error(fmt::format("{}: found '{}' in a face, expected the number of a vertex", where, word));
  return index;
}

Vector3<double> coordinates(const std::vector<std::string>& statement, const std::string& where) {
  if (statement.size() < 4)
    throw Error(fmt::format("{}: found {} coordinates of a vertex, expected 3", where, statement.size() - 1));
  return {parse_number(statement[1], where), parse_number(statement[2], where),
          parse_number(statement[3], where)};
}

/// The vertices of a face, counted from 1; `vertices` were defined before it.
std::vector<long> face_vertices(const std::vector<std::string>& statement, long vertices,
                                const std::string& where) {
  if (statement.size() < 4)
    throw Error(
        fmt::format("{}: found a face of {} vertices, expected at least 3", where, statement.size() - 1));
  std::vector<long> found;
  for (std::size_t i = 1; i < statement.size(); ++i) {
    const long index = face_vertex(statement[i], where);
    if (index == 0 || index < -vertices)
      throw Error(fmt::format("{}: found vertex {} in a face, expected 1 or more, or -{} to -1", where, index,
                              vertices));
    found.push_back(index > 0 ? index : vertices + 1 + index);
  }
  return found;
}

/// What else the format has; a line that starts with another word is none of an OBJ file.
bool is_passed_over(const std::string& keyword) {
  static const std::set<std::string_view> keywords{
      "vt",     "vn",     "vp",         "cstype",    "deg",  "bmat",     "step",     "p",      "l",
      "curv",   "curv2",  "surf",       "parm",      "trim", "hole",     "scrv",     "sp",     "end",
      "con",    "g",      "s",          "mg",        "o",    "bevel",    "lod",      "usemap", "maplib",
      "usemtl", "mtllib", "shadow_obj", "ctech",     "call", "c_interp", "d_interp", "csh",    "stech",
      "bsp",    "bzp",    "cdc",        "trace_obj", "cdp",  "res"};
  return keyword.starts_with('#') || keywords.contains(keyword);
}

}  // namespace

Mesh parse_obj(std::istream& in, const std::string& name) {
  struct Face {
    long line;
    std::vector<long> vertices;
  };
  Mesh mesh;
  std::vector<Face> faces;
  long number = 0;
  for (std::string line; std::getline(in, line);) {
    const std::string where = fmt::format("{}:{}", name, ++number);
    const auto statement = words(line);
    if (statement.empty()) continue;
    if (statement[0] == "v")
      mesh.points.push_back(coordinates(statement, where));
    else if (statement[0] == "f")
      faces.push_back({number, face_vertices(statement, static_cast<long>(mesh.points.size()), where)});
    else if (!is_passed_over(statement[0]))
      throw Error(fmt::format("{}: found '{}', expected a line of the OBJ format", where, statement[0]));
  }
  if (faces.empty()) throw Error(fmt::format("{}: found no face in {} lines, expected a mesh", name, number));
  const auto vertices = static_cast<long>(mesh.points.size());
  if (vertices > std::numeric_limits<int>::max())
    throw Error(fmt::format("{}: found {} vertices, expected fewer than 2^31", name, vertices));
  for (const auto& [line, face] : faces) {
    const long largest = *std::max_element(face.begin(), face.end());
    if (largest > vertices)  // a face may come before its vertices
      throw Error(fmt::format("{}:{}: found vertex {} in a face, expected at most {}, the number of vertices",
                              name, line, largest, vertices));
    for (std::size_t i = 2; i < face.size(); ++i)
      mesh.triangles.push_back(
          {static_cast<int>(face[0] - 1), static_cast<int>(face[i - 1] - 1), static_cast<int>(face[i] - 1)});
  }
  return mesh;
}

Mesh read_obj(const fs::path& file) {
  std::ifstream in(file);
  if (!in || fs::is_directory(file)) throw Error(fmt::format("{}: cannot be read", file.string()));
  Mesh mesh = parse_obj(in, file.string());
  if (in.bad()) throw Error(fmt::format("{}: cannot be read to its end", file.string()));
  return mesh;
}

MovingMesh make_moving_mesh(std::vector<Vector3<double>> start, std::vector<Vector3<double>> end,
                            std::vector<std::array<int, 3>> triangles) {
  std::set<std::array<int, 2>> edges;
  for (const auto& t : triangles)
    for (const auto& [a, b] : {std::pair{t[0], t[1]}, std::pair{t[1], t[2]}, std::pair{t[2], t[0]}})
      if (a != b) edges.insert({std::min(a, b), std::max(a, b)});
  return {std::move(start), std::move(end), std::move(triangles), {edges.begin(), edges.end()}};
}

MovingMesh read_moving_mesh(const fs::path& start, const fs::path& end) {
  Mesh first = read_obj(start);
  Mesh last = read_obj(end);
  if (first.points.size() != last.points.size())
    throw Error(fmt::format("{}: found {} vertices, expected {} as in {}", end.string(), last.points.size(),
                            first.points.size(), start.string()));
  if (first.triangles.size() != last.triangles.size())
    throw Error(fmt::format("{}: found {} triangles, expected {} as in {}", end.string(),
                            last.triangles.size(), first.triangles.size(), start.string()));
  const auto [a, b] = std::mismatch(first.triangles.begin(), first.triangles.end(), last.triangles.begin());
  if (a != first.triangles.end())
    throw Error(fmt::format("{}: found triangle {} of vertices {} {} {}, expected {} {} {} as in {}",
                            end.string(), b - last.triangles.begin() + 1, (*b)[0] + 1, (*b)[1] + 1,
                            (*b)[2] + 1, (*a)[0] + 1, (*a)[1] + 1, (*a)[2] + 1, start.string()));
  return make_moving_mesh(std::move(first.points), std::move(last.points), std::move(first.triangles));
}

}  // namespace nearmiss
