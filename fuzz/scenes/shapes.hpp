// Meshes that scenes made by formula are put together from. Their edges are about 1 long.
#pragma once

#include <functional>

#include "fuzz/meshes/mesh.hpp"

namespace nearmiss {

using Points = std::vector<Vector3<double>>;

/// Adds the triangles of a surface whose points are there in rows, from `first` on: two for each square, with
/// diagonals that alternate. The rows of a closed one are rings.
void add_surface(Mesh& mesh, int first, int rows, int columns, bool closed = false);

/// Adds the lines that join `count` points, from `first` on, to a polyline.
void add_polyline(Mesh& mesh, int first, int count);

/// Adds the triangles of a part whose points are there from `first` on.
void add_triangles(Mesh& mesh, const Mesh& part, int first);

/// (squares + 1)² points in rows, each where `place` says; that takes x and y in edges from the sheet's
/// centre.
Points sheet_points(int squares, const std::function<Vector3<double>(double x, double y)>& place);

/// The surface of a box of so many edges, each 1 long, around the origin: 4 (ab + bc + ca) triangles.
Mesh box(const std::array<int, 3>& edges);

/// A ball around the origin, of 12 squares² triangles: a cube's surface, with points moved to the sphere.
Mesh ball(int squares);

}  // namespace nearmiss
