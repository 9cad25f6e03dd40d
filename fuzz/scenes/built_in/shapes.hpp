// The meshes that built-in scenes consist of. Their edges are about 1 long.
#pragma once

#include <functional>

#include "fuzz/meshes/mesh.hpp"

namespace nearmiss {

using PointList = std::vector<Vector3<double>>;

/// Adds the triangles of a surface whose points, from number `first` on, are in rows. Each square has two
/// triangles, with alternating diagonals. The rows of a closed surface are rings.
void add_surface(Mesh& mesh, int first, int rows, int columns, bool closed = false);

/// Adds the lines of a polyline through `count` points, from number `first` on.
void add_polyline(Mesh& mesh, int first, int count);

/// Adds the triangles of `part`; its points are those of `mesh` from number `first` on.
void add_triangles(Mesh& mesh, const Mesh& part, int first);

/// A square sheet with (squares + 1)² points in rows. `place` maps a point of the flat sheet to its position;
/// x and y are measured from the centre, in edges.
PointList sheet_points(int squares, const std::function<Vector3<double>(double x, double y)>& place);

/// The surface of a box around the origin. For edges = {a, b, c}, its sides have a, b and c edges of length
/// 1, and it has 4 (ab + bc + ca) triangles.
Mesh box(const std::array<int, 3>& edges);

/// A sphere around the origin with 12 squares² triangles. Its points are those of the surface of a cube,
/// moved to the sphere.
Mesh ball(int squares);

}  // namespace nearmiss
