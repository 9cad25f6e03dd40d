// The meshes that built-in scenes consist of. Their edges are about 1 long.
#pragma once

#include <functional>

#include "fuzz/meshes/mesh.hpp"

namespace nearmiss {

using PointList = std::vector<Vector3<double>>;

/// Adds the triangles of a surface. The points of the surface have the numbers from `first` on, row by row.
/// Each square between four neighbouring points is divided into two triangles, and the direction of the
/// diagonal alternates from square to square. The rows of a closed surface are rings.
void add_surface(Mesh& mesh, int first, int rows, int columns, bool closed = false);

/// Adds the lines of a polyline through `count` points, from number `first` on.
void add_polyline(Mesh& mesh, int first, int count);

/// Adds the triangles of `part` to `mesh`. Point i of `part` is point first + i of `mesh`.
void add_triangles(Mesh& mesh, const Mesh& part, int first);

/// The points of a square sheet, (squares + 1)² of them, row by row. `place` maps a point (x, y) of the flat
/// sheet to its position; x and y are measured from the centre of the sheet, and an edge has length 1.
PointList sheet_points(int squares, const std::function<Vector3<double>(double x, double y)>& place);

/// The surface of a box around the origin. For edges = {a, b, c}, its sides have a, b and c edges of length
/// 1, and it has 4 (ab + bc + ca) triangles.
Mesh box(const std::array<int, 3>& edges);

/// A sphere around the origin, with 12 * squares * squares triangles. The mesh is the surface of a cube with
/// all points moved to the sphere.
Mesh ball(int squares);

}  // namespace nearmiss
