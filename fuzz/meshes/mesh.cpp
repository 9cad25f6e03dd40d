#include "fuzz/meshes/mesh.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <numeric>
#include <string_view>

#include "ccd/error.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

/// Throws Error where two lists of primitives differ.
template <std::size_t n>
void expect_same(const std::vector<std::array<int, n>>& first, const std::string& first_name,
                 const std::vector<std::array<int, n>>& other, const std::string& other_name,
                 std::string_view one, std::string_view many) {
  if (first.size() != other.size())
    throw Error(fmt::format("{}: found {} {}, expected {} as in {}", other_name, other.size(), many,
                            first.size(), first_name));
  const auto [a, b] = std::mismatch(first.begin(), first.end(), other.begin());
  if (a == first.end()) return;
  const auto counted_from_one = [](std::array<int, n> primitive) {
    for (int& vertex : primitive) ++vertex;
    return primitive;
  };
  throw Error(fmt::format("{}: found {} {} of vertices {}, expected {} as in {}", other_name, one,
                          b - other.begin() + 1, fmt::join(counted_from_one(*b), " "),
                          fmt::join(counted_from_one(*a), " "), first_name));
}

using Reader = Mesh (*)(std::istream&, const std::string&);

const std::map<std::string, Reader>& readers() {
  static const std::map<std::string, Reader> by_ending{
      {".obj", parse_obj}, {".off", parse_off}, {".ply", parse_ply}, {".stl", parse_stl}};
  return by_ending;
}

}  // namespace

std::string mesh_ending(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return readers().contains(ending) ? ending : "";
}

Mesh read_mesh(const fs::path& file) {
  const auto reader = readers().find(mesh_ending(file));
  if (reader == readers().end())
    throw Error(fmt::format("{}: found the ending '{}', expected .obj, .off, .ply or .stl", file.string(),
                            file.extension().string()));
  std::ifstream in(file, std::ios::binary);
  if (!in || fs::is_directory(file)) throw Error(fmt::format("{}: cannot be read", file.string()));
  return reader->second(in, file.string());
}

Bodies bodies(const Mesh& mesh) {
  // Of each point one of the same body with a smaller number, or itself: the way leads to the smallest.
  std::vector<int> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto at = [&](int point) -> int& { return parent[static_cast<std::size_t>(point)]; };
  const auto smallest = [&](int point) {
    while (at(point) != point) point = at(point) = at(at(point));
    return point;
  };
  const auto join = [&](int a, int b) {
    const auto [first, second] = std::minmax({smallest(a), smallest(b)});
    at(second) = first;
  };
  for (const auto& [a, b] : mesh.lines) join(a, b);
  for (const auto& [a, b, c] : mesh.triangles) {
    join(a, b);
    join(a, c);
  }
  Bodies found{0, std::vector<int>(mesh.points.size())};
  for (std::size_t i = 0; i < parent.size(); ++i) {
    const auto first = static_cast<std::size_t>(smallest(static_cast<int>(i)));
    found.of_point[i] = first == i ? found.count++ : found.of_point[first];
  }
  return found;
}

MovingMesh make_moving_mesh(Mesh mesh, std::vector<Vector3<double>> end) {
  std::vector<std::array<int, 2>> edges;
  edges.reserve(3 * mesh.triangles.size() + mesh.lines.size());
  const auto add = [&](int a, int b) {
    if (a != b) edges.push_back({std::min(a, b), std::max(a, b)});
  };
  for (const auto& [a, b] : mesh.lines) add(a, b);
  for (const auto& [a, b, c] : mesh.triangles) {
    add(a, b);
    add(b, c);
    add(c, a);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return {std::move(mesh.points), std::move(end), std::move(mesh.triangles), std::move(edges)};
}

void expect_same_primitives(const Mesh& first, const std::string& first_name, const Mesh& other,
                            const std::string& other_name) {
  if (first.points.size() != other.points.size())
    throw Error(fmt::format("{}: found {} vertices, expected {} as in {}", other_name, other.points.size(),
                            first.points.size(), first_name));
  expect_same(first.triangles, first_name, other.triangles, other_name, "triangle", "triangles");
  expect_same(first.lines, first_name, other.lines, other_name, "line", "lines");
}

}  // namespace nearmiss
