// Meshes, at rest and moving.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// Points, and the primitives that join them: triangles of surfaces, and lines of hair. A point may be in no
/// primitive. Indices count from 0 and are in range.
struct Mesh {
  std::vector<Vector3<double>> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> lines;
};

/// Adds the triangles of a polygon: a fan around the polygon's first vertex. `polygon` has the indices of its
/// vertices, which count from 0.
void add_polygon(Mesh& mesh, std::span<const long> polygon);

/// Throws Error if the file `name` has no points, or more points than an int can count.
void expect_points(std::size_t points, std::string_view name);

/// Throws Error if the two meshes differ in the number of points or in a primitive. The message calls the
/// meshes by the given names.
void expect_same_primitives(const Mesh& first, const std::string& first_name, const Mesh& other,
                            const std::string& other_name);

/// The connected components of a mesh.
struct Bodies {
  int count = 0;
  /// The number of the body to which each point belongs. Bodies are numbered from 0, in the order of their
  /// first points.
  std::vector<int> of_point;
};

/// The bodies of a mesh. Points that a triangle or a line joins belong to the same body, and a point in no
/// primitive is a body of its own.
Bodies bodies(const Mesh& mesh);

/// A mesh whose points move linearly.
struct MovingMesh {
  std::vector<Vector3<double>> start, end;
  std::vector<std::array<int, 3>> triangles;
  /// The edges of the triangles, and the lines. Each edge occurs once, and the edges are in ascending order.
  /// The smaller index of an edge comes first.
  std::vector<std::array<int, 2>> edges;
  double separation = 0;  ///< the separation h in the queries of all pairs
};

/// Makes a moving mesh. `mesh` is the mesh at the start of the step, and `end` has the positions of its
/// points at the end of the step.
MovingMesh make_moving_mesh(Mesh mesh, std::vector<Vector3<double>> end);

}  // namespace nearmiss
