// Scenes: meshes that move from frame to frame, read from files or computed by a formula.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

#include "fuzz/meshes/mesh.hpp"

namespace nearmiss {

/// A mesh that moves. Step i goes from frame i to frame i + 1.
struct Scene {
  std::string name;        ///< without folder and ending
  std::size_t frames = 2;  ///< at least 2
  Mesh mesh;               ///< at frame 0
  /// The points of a frame, which are read or computed on demand. Throws Error if the frame does not have the
  /// same primitives as the other frames.
  std::function<std::vector<Vector3<double>>(std::size_t frame)> points;
  double separation = 0;  ///< the separation h in the queries of all pairs

  [[nodiscard]] std::size_t steps() const { return frames - 1; }
};

/// The same scene with a separation h > 0, named NAME~H.
Scene with_separation(Scene scene, double separation);

MovingMesh moving_mesh(const Scene& scene, std::size_t step);

/// Calls visit(step, mesh) for the steps of a scene, in order, until `is_over` returns true. `mesh` is always
/// the same object: for each step, it gets the positions of that step. This takes less time than a call of
/// moving_mesh() for each step.
void for_each_step(const Scene& scene, const std::function<bool()>& is_over,
                   const std::function<void(std::size_t step, const MovingMesh& mesh)>& visit);

/// The name under which all pairs of a simulation are counted: "scene:NAME".
std::string scene_family(const Scene& scene);

/// The name under which the pairs of a step are counted: "scene:NAME", or "scene:NAME#STEP" if there are
/// several steps. No family of random queries has such a name.
std::string step_name(const Scene& scene, std::size_t step);

/// A scene of one step. One file has the mesh at t = 0, and the other file has the same mesh at t = 1. Throws
/// Error if read_mesh does, or if the primitives of the two files differ.
Scene scene_of_files(const std::filesystem::path& start, const std::filesystem::path& end);

/// A scene whose frames are the mesh files of a folder, in the order of their names. Numbers in names are
/// compared by their values: frame 2 comes before frame 10. Files without the ending of a mesh format
/// (pictures, notes), hidden files (".frame.obj") and folders are skipped. Throws Error if there are fewer
/// than two mesh files, or if the files' endings differ, since it is then unclear which files are the frames.
Scene scene_of_folder(const std::filesystem::path& folder);

/// The scene with all points merged that coincide at frame 0; coordinates 0 and -0 are equal. Mesh files
/// repeat points at seams. Without merging, triangles on the two sides of a seam would have no common vertex,
/// so they would be tested for collision. After merging, a triangle may have a vertex twice. For a frame in
/// which merged points are apart, the result's `points` throws Error.
Scene welded(Scene scene);

}  // namespace nearmiss
