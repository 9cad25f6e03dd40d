// Meshes that move from one step to the next.
#pragma once

#include <array>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "ccd/query.hpp"

namespace nearmiss {

/// Points, and the figures that join them: triangles of surfaces, and lines of hair; a point may be in none.
/// Indices count from 0 and are in range.
struct Mesh {
  std::vector<Vector3<double>> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> lines;
};

/// Reads an OBJ file: vertices, faces (polygons become fans of triangles) and polylines; all else that the
/// format has is passed over. `name` stands for the file in messages. Throws Error with file and line for what
/// is no finite number, a figure with a vertex that does not exist or with too few, and a line that is not of
/// the format; and for a file without a point.
Mesh parse_obj(std::istream& in, const std::string& name);

/// Reads a file by its ending. Throws Error as parse_obj does, and where it cannot be read or has another
/// ending.
Mesh read_mesh(const std::filesystem::path& file);

/// A mesh whose points move linearly.
struct MovingMesh {
  std::vector<Vector3<double>> start, end;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>>
      edges;  ///< of triangles and lines, each once, the smaller index first, ascending
};

/// A moving mesh from its parts; `mesh` gives the start.
MovingMesh make_moving_mesh(Mesh mesh, std::vector<Vector3<double>> end);

/// Throws Error where the two do not have the same number of points and the same figures; the names stand for
/// them in the message.
void expect_same_figures(const Mesh& first, const std::string& first_name, const Mesh& other,
                         const std::string& other_name);

}  // namespace nearmiss
