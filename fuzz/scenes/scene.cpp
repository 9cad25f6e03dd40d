#include "fuzz/scenes/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <memory>
#include <string_view>
#include <vector>

#include "ccd/query/error.hpp"
#include "ccd/query/printable.hpp"
#include "fuzz/meshes/formats.hpp"
#include "reports/statistics/family_name.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// Removes the digits at the front of a text, and returns them without leading zeros.
std::string_view cut_number(std::string_view& text) {
  const std::string_view all = text.substr(0, std::min(text.find_first_not_of("0123456789"), text.size()));
  text.remove_prefix(all.size());
  return all.substr(std::min(all.find_first_not_of('0'), all.size()));
}

/// Whether name a comes before name b. Numbers in the names are compared by their values, and all other
/// characters one by one.
bool comes_before(std::string_view a, std::string_view b) {
  const std::string_view whole_a = a;
  const std::string_view whole_b = b;
  while (!a.empty() && !b.empty()) {
    if (is_digit(a[0]) && is_digit(b[0])) {
      const std::string_view x = cut_number(a);
      const std::string_view y = cut_number(b);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else {
      if (a[0] != b[0]) return a[0] < b[0];
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  if (a.empty() != b.empty()) return a.empty();
  return whole_a < whole_b;  // here the values of all numbers in a and b are equal, as for the names 1 and 01
}

/// The mesh files of a folder, in the order of their names.
std::vector<fs::path> mesh_files(const fs::path& folder) {
  const auto is_frame = [](const fs::directory_entry& entry) {
    return entry.is_regular_file() && !mesh_ending(entry).empty() &&
           !entry.path().filename().string().starts_with('.');
  };
  std::vector<fs::path> files;
  try {
    for (const auto& entry : fs::directory_iterator(folder))
      if (is_frame(entry)) files.push_back(entry.path());
  } catch (const fs::filesystem_error&) {
    throw Error(fmt::format("{}: cannot be read as a folder", folder.string()));
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return comes_before(a.filename().string(), b.filename().string());
  });
  return files;
}

/// The printable name of a folder, even if the path ends in a slash or a dot.
std::string folder_name(const fs::path& folder) {
  return printable((fs::absolute(folder) / "").lexically_normal().parent_path().filename().string());
}

/// Returns, for each point, the index of the first point in the same place.
std::vector<std::size_t> first_in_place(const std::vector<Vector3<double>>& points) {
  std::map<std::array<double, 3>, std::size_t> places;  // in this map's keys, 0 and -0 are equal
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < points.size(); ++i)
    first.push_back(places.try_emplace({points[i][0], points[i][1], points[i][2]}, i).first->second);
  return first;
}

/// The points of a frame that remain after points are merged. If several points are in one place at frame 0,
/// only the point with the lowest index is kept. Throws Error if, in this frame, one of the other points is
/// not in the same place as the kept point.
std::vector<Vector3<double>> kept_points(const std::vector<Vector3<double>>& points,
                                         const std::vector<std::size_t>& first, const std::string& where) {
  std::vector<Vector3<double>> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i] != points[first[i]])
      throw Error(
          fmt::format("{}: found vertices {} and {} apart, expected them in one place as at frame 0, where "
                      "they were made one",
                      where, first[i] + 1, i + 1));
    if (first[i] == i) kept.push_back(points[i]);
  }
  return kept;
}

template <std::size_t n>
void renumber(std::vector<std::array<int, n>>& primitives, const std::vector<int>& number) {
  for (auto& primitive : primitives)
    for (int& vertex : primitive) vertex = number[static_cast<std::size_t>(vertex)];
}

}  // namespace

MovingMesh moving_mesh(const Scene& scene, std::size_t step) {
  Mesh mesh = scene.mesh;
  if (step > 0) mesh.points = scene.points(step);
  MovingMesh moving = make_moving_mesh(std::move(mesh), scene.points(step + 1));
  moving.separation = scene.separation;
  return moving;
}

void for_each_step(const Scene& scene, const std::function<bool()>& is_over,
                   const std::function<void(std::size_t, const MovingMesh&)>& visit) {
  MovingMesh mesh;
  for (std::size_t step = 0; step < scene.steps() && !is_over(); ++step) {
    if (step == 0) {
      mesh = moving_mesh(scene, 0);
    } else {
      mesh.start = std::move(mesh.end);
      mesh.end = scene.points(step + 1);
    }
    if (!is_over()) visit(step, mesh);
  }
}

Scene with_separation(Scene scene, double separation) {
  scene.separation = separation;
  scene.name = name_with_separation(scene.name, fmt::format("{}", separation));
  return scene;
}

std::string scene_family(const Scene& scene) { return fmt::format("scene:{}", scene.name); }

std::string step_name(const Scene& scene, std::size_t step) {
  return scene.steps() == 1 ? scene_family(scene) : fmt::format("{}#{}", scene_family(scene), step);
}

Scene scene_of_files(const fs::path& start, const fs::path& end) {
  Mesh first = read_mesh(start);
  Mesh last = read_mesh(end);
  expect_same_primitives(first, start.string(), last, end.string());
  std::vector<std::vector<Vector3<double>>> points{first.points, std::move(last.points)};
  return {.name = printable(start.stem().string()),
          .frames = 2,
          .mesh = std::move(first),
          .points = [points = std::move(points)](std::size_t frame) { return points.at(frame); }};
}

Scene scene_of_folder(const fs::path& folder) {
  const std::vector<fs::path> files = mesh_files(folder);
  if (files.size() < 2)
    throw Error(
        fmt::format("{}: found {} files with a mesh, expected at least 2", folder.string(), files.size()));
  for (const fs::path& file : files)
    if (mesh_ending(file) != mesh_ending(files[0]))
      throw Error(fmt::format("{}: found {} and {}, expected meshes with one ending", folder.string(),
                              files[0].filename().string(), file.filename().string()));
  const auto first = std::make_shared<const Mesh>(read_mesh(files[0]));
  return {.name = folder_name(folder),
          .frames = files.size(),
          .mesh = *first,
          .points = [files, first](std::size_t frame) {
            if (frame == 0) return first->points;
            Mesh mesh = read_mesh(files.at(frame));
            expect_same_primitives(*first, files[0].string(), mesh, files[frame].string());
            return std::move(mesh.points);
          }};
}

Scene welded(Scene scene) {
  const std::vector<std::size_t> first = first_in_place(scene.mesh.points);
  std::vector<int> number(first.size());
  int count = 0;
  for (std::size_t i = 0; i < first.size(); ++i) number[i] = first[i] == i ? count++ : number[first[i]];
  renumber(scene.mesh.triangles, number);
  renumber(scene.mesh.lines, number);
  scene.mesh.points = kept_points(scene.mesh.points, first, scene.name);
  scene.points = [points = std::move(scene.points), first, name = scene.name](std::size_t frame) {
    return kept_points(points(frame), first, fmt::format("{}, frame {}", name, frame));
  };
  return scene;
}

}  // namespace nearmiss
