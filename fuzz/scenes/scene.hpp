// Scenes: meshes that move from frame to frame, from files or made by a formula.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

#include "fuzz/meshes/mesh.hpp"

namespace nearmiss {

/// A mesh that moves: step i goes from frame i to frame i + 1.
struct Scene {
  std::string name;        ///< without folder and ending
  std::size_t frames = 2;  ///< at least 2
  Mesh mesh;               ///< at frame 0
  /// The points of a frame, read or made when asked for. Throws Error where the frame does not have the same
  /// primitives as the others.
  std::function<std::vector<Vector3<double>>(std::size_t frame)> points;

  [[nodiscard]] std::size_t steps() const { return frames - 1; }
};

/// One step of a scene.
MovingMesh moving_mesh(const Scene& scene, std::size_t step);

/// What a step's pairs are counted under: "scene:NAME", or "scene:NAME#STEP" where there are several. No
/// family of random queries has such a name.
std::string step_name(const Scene& scene, std::size_t step);

/// The same mesh at t = 0 and at t = 1, from two files. Throws Error.
Scene scene_of_files(const std::filesystem::path& start, const std::filesystem::path& end);

/// The frames are the mesh files of a folder, by name, where numbers count as such: frame 2 comes before
/// frame 10. What has no ending of a mesh (pictures, notes), is hidden (".frame.obj") or is a folder is
/// passed over. Throws Error where there are fewer than two, or meshes with several endings, since nobody
/// knows which are meant.
Scene scene_of_folder(const std::filesystem::path& folder);

/// The scene with points that are in one place at frame 0 (0 and -0 are equal) made one, and the primitives
/// renumbered: files repeat points at seams, and neighbours that share none would be tested for collision. A
/// triangle may become one that has a vertex twice. `points` throws Error for a frame that tears such points
/// apart.
Scene welded(Scene scene);

}  // namespace nearmiss
