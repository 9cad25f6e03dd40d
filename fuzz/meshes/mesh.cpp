#include "fuzz/meshes/mesh.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "ccd/query/error.hpp"

namespace nearmiss {

namespace {

/// Throws Error if two lists of primitives differ. The message shows the first difference.
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

}  // namespace

void add_polygon(Mesh& mesh, std::span<const long> polygon) {
  const auto vertex = [&](std::size_t i) { return static_cast<int>(polygon[i]); };
  for (std::size_t i = 2; i < polygon.size(); ++i)
    mesh.triangles.push_back({vertex(0), vertex(i - 1), vertex(i)});
}

void expect_points(std::size_t points, std::string_view name) {
  if (points == 0) throw Error(fmt::format("{}: found no vertex, expected at least one", name));
  if (points > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw Error(fmt::format("{}: found {} vertices, expected fewer than 2^31", name, points));
}

void expect_same_primitives(const Mesh& first, const std::string& first_name, const Mesh& other,
                            const std::string& other_name) {
  if (first.points.size() != other.points.size())
    throw Error(fmt::format("{}: found {} vertices, expected {} as in {}", other_name, other.points.size(),
                            first.points.size(), first_name));
  expect_same(first.triangles, first_name, other.triangles, other_name, "triangle", "triangles");
  expect_same(first.lines, first_name, other.lines, other_name, "line", "lines");
}

Bodies bodies(const Mesh& mesh) {
  // parent[i] is i itself, or a point with a smaller number that belongs to the same body as i. The chain of
  // parents ends at the smallest number found so far in the body.
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

}  // namespace nearmiss
