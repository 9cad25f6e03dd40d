#include "fuzz/mesh.hpp"

#include <CGAL/IO/OBJ.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <set>
#include <sstream>

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

/// The library's reader says only that something is wrong; this says what and where. It keeps nothing.
void check_obj(std::istream& in, const std::string& name) {
  struct Face {
    long line;
    long largest;
  };
  std::vector<Face> faces;
  long vertices = 0;
  long number = 0;
  for (std::string line; std::getline(in, line);) {
    const std::string where = fmt::format("{}:{}", name, ++number);
    const auto found = words(line);
    if (found.empty()) continue;
    if (found[0] == "v") {
      if (found.size() < 4)
        throw Error(fmt::format("{}: found {} coordinates of a vertex, expected 3", where, found.size() - 1));
      for (std::size_t i = 1; i < 4; ++i) parse_number(found[i], where);
      ++vertices;
    } else if (found[0] == "f") {
      if (found.size() < 4)
        throw Error(
            fmt::format("{}: found a face of {} vertices, expected at least 3", where, found.size() - 1));
      Face face{number, 0};
      for (std::size_t i = 1; i < found.size(); ++i) {
        const long index = face_vertex(found[i], where);
        if (index == 0 || index < -vertices)
          throw Error(fmt::format("{}: found vertex {} in a face, expected 1 or more, or -{} to -1", where,
                                  index, vertices));
        face.largest = std::max(face.largest, index);
      }
      faces.push_back(face);
    }
  }
  if (faces.empty()) throw Error(fmt::format("{}: found no face in {} lines, expected a mesh", name, number));
  for (const Face& face : faces)
    if (face.largest > vertices)
      throw Error(fmt::format("{}:{}: found vertex {} in a face, expected at most {}, the number of vertices",
                              name, face.line, face.largest, vertices));
}

}  // namespace

Mesh read_obj(const fs::path& file) {
  const std::string name = file.string();
  std::ifstream in(file);
  if (!in || fs::is_directory(file)) throw Error(fmt::format("{}: cannot be read", name));
  check_obj(in, name);
  in.clear();
  in.seekg(0);
  std::vector<CGAL::Simple_cartesian<double>::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  if (!CGAL::IO::read_OBJ(in, points, polygons))
    throw Error(fmt::format("{}: found a line that is not of the OBJ format", name));

  Mesh mesh;
  for (const auto& p : points) mesh.points.emplace_back(p.x(), p.y(), p.z());
  for (const auto& polygon : polygons)
    for (std::size_t i = 2; i < polygon.size(); ++i)
      mesh.triangles.push_back(
          {static_cast<int>(polygon[0]), static_cast<int>(polygon[i - 1]), static_cast<int>(polygon[i])});
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
