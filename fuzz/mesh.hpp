// Triangle meshes that move from one step to the next.
#pragma once

#include <array>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "ccd/query.hpp"

namespace nearmiss {

/// Triangles over points; indices count from 0 and are in range.
struct Mesh {
  std::vector<Vector3<double>> points;
  std::vector<std::array<int, 3>> triangles;
};

/// Reads an OBJ file: vertices and faces (polygons become fans of triangles), all else that the format has is
/// passed over. `name` stands for the file in messages. Throws Error with file and line for what is no finite
/// number, a face with a vertex that does not exist or with fewer than three, and a line that is not of the
/// format; and for a file without a face.
Mesh parse_obj(std::istream& in, const std::string& name);

/// The same from a file; throws Error where it cannot be read, too.
Mesh read_obj(const std::filesystem::path& file);

/// A mesh whose points move linearly.
struct MovingMesh {
  std::vector<Vector3<double>> start, end;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> edges;  ///< each once, the smaller index first, in ascending order
};

/// The same mesh at t = 0 and t = 1. Throws Error where the files do not have the same points and triangles.
MovingMesh read_moving_mesh(const std::filesystem::path& start, const std::filesystem::path& end);

/// A moving mesh from its parts.
MovingMesh make_moving_mesh(std::vector<Vector3<double>> start, std::vector<Vector3<double>> end,
                            std::vector<std::array<int, 3>> triangles);

}  // namespace nearmiss
