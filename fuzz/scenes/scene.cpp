#include "fuzz/scenes/scene.hpp"

#include <fmt/format.h>

namespace nearmiss {

namespace fs = std::filesystem;

MovingMesh moving_mesh(const Scene& scene, std::size_t step) {
  Mesh mesh = scene.mesh;
  if (step > 0) mesh.points = scene.points(step);
  return make_moving_mesh(std::move(mesh), scene.points(step + 1));
}

std::string step_name(const Scene& scene, std::size_t step) {
  if (scene.steps() == 1) return fmt::format("scene:{}", scene.name);
  return fmt::format("scene:{}#{}", scene.name, step);
}

Scene scene_of_files(const fs::path& start, const fs::path& end) {
  Mesh first = read_mesh(start);
  Mesh last = read_mesh(end);
  expect_same_figures(first, start.string(), last, end.string());
  std::vector<std::vector<Vector3<double>>> points{first.points, std::move(last.points)};
  return {.name = start.stem().string(),
          .frames = 2,
          .mesh = std::move(first),
          .points = [points = std::move(points)](std::size_t frame) { return points.at(frame); }};
}

}  // namespace nearmiss
