#include "fuzz/simulation/simulated_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "fuzz/scenes/built_in/formulas.hpp"
#include "fuzz/scenes/built_in/shapes.hpp"

namespace nearmiss {

namespace {

using Held = std::vector<bool>;

/// Holds the first and the last ring of a tube whose points are in rings.
Held ends_of_tube(const Mesh& mesh) {
  const std::size_t ring = mesh.points.size() - mesh.triangles.size() / 2;
  Held held(mesh.points.size());
  std::fill_n(held.begin(), ring, true);
  std::fill_n(held.rbegin(), ring, true);
  return held;
}

/// Holds the points of all bodies except the first.
Held other_bodies(const Mesh& mesh) {
  Held held;
  for (const int body : bodies(mesh).of_point) held.push_back(body != 0);
  return held;
}

Held ends_of_lines(const Mesh& mesh) {
  std::vector<int> lines(mesh.points.size());
  for (const auto& line : mesh.lines)
    for (const int point : line) ++lines[static_cast<std::size_t>(point)];
  Held held;
  for (const int count : lines) held.push_back(count == 1);
  return held;
}

/// Two equal sheets. Each vertex of the second sheet is exactly above a vertex of the first sheet.
Scene two_sheets(int size) {
  const int squares = std::max(2, nearest(std::sqrt(size / 4.0)));
  const int in_sheet = (squares + 1) * (squares + 1);
  Mesh mesh;
  for (const double height : {0.0, 2.0}) {
    const auto place = [&](double x, double y) { return Vector3<double>(x, y, height); };
    for (const auto& p : sheet_points(squares, place)) mesh.points.push_back(p);
  }
  for (const int first : {0, in_sheet}) add_surface(mesh, first, squares + 1, squares + 1);
  const auto points = mesh.points;
  return {.name = {}, .frames = 26, .mesh = std::move(mesh), .points = [points](std::size_t /*frame*/) {
            return points;
          }};
}

Held corners_of_first_sheet(const Mesh& mesh) {
  const auto in_sheet = mesh.points.size() / 2;
  const auto side = static_cast<std::size_t>(nearest(std::sqrt(static_cast<double>(in_sheet))));
  Held held(mesh.points.size());
  for (const std::size_t corner : {std::size_t{0}, side - 1, in_sheet - side, in_sheet - 1})
    held[corner] = true;
  return held;
}

/// Makes the built-in scene `name` in a given size.
std::function<Scene(int size)> built_in(const std::string& name) {
  return [name](int size) { return built_in_scene(fmt::format("{}@{}", name, size)); };
}

constexpr int largest = 20'000;  // factorising the matrix of this size takes less than a second

}  // namespace

const std::vector<BuiltInScene>& simulated_scenes() {
  static const std::vector<BuiltInScene> all{
      {"knot", "a tube with an overhand knot, which is pulled tight by its ends", 1200, 300, largest,
       built_in("knot"), ends_of_tube},
      {"cloths", "a cloth falls, vertex on vertex, on an equal one that is held by its corners", 800, 16,
       largest, two_sheets, corners_of_first_sheet},
      {"spikes", "a cloth falls on a square of spikes", 1200, 300, largest, built_in("spikes"), other_bodies},
      {"hair", "a bundle of hair is twisted by its ends: lines only", 600, 100, largest, built_in("hair"),
       ends_of_lines}};
  return all;
}

SimulatedScene simulated_scene(const std::string& text) {
  const BuiltInScene* scene = find_scene(text, simulated_scenes());
  if (scene == nullptr)
    throw Error(
        fmt::format("{}: found no scene of that name that can be simulated (see nearmiss simulate --list)",
                    excerpt(text)));
  SimulatedScene made{.scene = make_scene(text, *scene), .held = {}};
  made.held = scene->held(made.scene.mesh);
  return made;
}

}  // namespace nearmiss
