#include "fuzz/scenes/built_in/shapes.hpp"

#include "fuzz/scenes/built_in/formulas.hpp"

namespace nearmiss {

namespace {

/// Adds the two triangles of a square, whose corners are a, b, c and d in this order.
void add_square(Mesh& mesh, int a, int b, int c, int d, bool other_diagonal) {
  if (other_diagonal) {
    mesh.triangles.push_back({a, b, d});
    mesh.triangles.push_back({b, c, d});
  } else {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
}

}  // namespace

void add_surface(Mesh& mesh, int first, int rows, int columns, bool closed) {
  const auto point = [&](int row, int column) { return first + row * columns + column % columns; };
  for (int row = 0; row + 1 < rows; ++row)
    for (int column = 0; column + 1 < columns + (closed ? 1 : 0); ++column)
      add_square(mesh, point(row, column), point(row, column + 1), point(row + 1, column + 1),
                 point(row + 1, column), (row + column) % 2 != 0);
}

void add_polyline(Mesh& mesh, int first, int count) {
  for (int i = first; i + 1 < first + count; ++i) mesh.lines.push_back({i, i + 1});
}

void add_triangles(Mesh& mesh, const Mesh& part, int first) {
  for (const auto& [a, b, c] : part.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

PointList sheet_points(int squares, const std::function<Vector3<double>(double x, double y)>& place) {
  PointList points;
  points.reserve(static_cast<std::size_t>(squares + 1) * static_cast<std::size_t>(squares + 1));
  const double middle = squares / 2.0;
  for (int row = 0; row <= squares; ++row)
    for (int column = 0; column <= squares; ++column) points.push_back(place(column - middle, row - middle));
  return points;
}

Mesh box(const std::array<int, 3>& edges) {
  Mesh mesh;
  const auto in_row = static_cast<std::size_t>(edges[0] + 1);
  const auto in_layer = in_row * static_cast<std::size_t>(edges[1] + 1);
  std::vector<int> number(in_layer * static_cast<std::size_t>(edges[2] + 1), -1);
  // Returns the number of the point at a place on the surface. Adds the point if it does not exist yet.
  const auto point = [&](const std::array<int, 3>& at) {
    int& found = number[static_cast<std::size_t>(at[2]) * in_layer +
                        static_cast<std::size_t>(at[1]) * in_row + static_cast<std::size_t>(at[0])];
    if (found < 0) {
      found = static_cast<int>(mesh.points.size());
      mesh.points.emplace_back(at[0] - edges[0] / 2.0, at[1] - edges[1] / 2.0, at[2] - edges[2] / 2.0);
    }
    return found;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    for (const bool far : {false, true})
      for (int i = 0; i < edges[u]; ++i)
        for (int j = 0; j < edges[v]; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> at{};
            at[axis] = far ? edges[axis] : 0;
            at[u] = i + di;
            at[v] = j + dj;
            return point(at);
          };
          const std::array around{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
          add_square(mesh, around[0], around[far ? 1 : 3], around[2], around[far ? 3 : 1], (i + j) % 2 != 0);
        }
  }
  return mesh;
}

Mesh ball(int squares) {
  Mesh mesh = box({squares, squares, squares});
  // The circumference of the sphere is about 4 `squares`, like that of the cube.
  const double radius = squares * 0.64;
  for (auto& p : mesh.points) p = p * (radius / length(p));
  return mesh;
}

}  // namespace nearmiss
