// OFF, PLY and STL with CGAL: the only file that includes its readers.
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>

#include "fuzz/meshes/lines.hpp"
#include "fuzz/meshes/mesh.hpp"
#include "fuzz/meshes/plain.hpp"

namespace nearmiss {

namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Polygon = std::vector<std::size_t>;

/// Points and polygons as CGAL's readers give them.
struct Soup {
  std::vector<Point> points;
  std::vector<Polygon> polygons;
};

void expect_finite(const std::vector<Point>& points, const std::string& name) {
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const double c : {points[i].x(), points[i].y(), points[i].z()})
      if (!std::isfinite(c))
        throw Error(fmt::format("{}: found {} in vertex {}, expected a finite number", name, c, i + 1));
}

/// Throws Error where a polygon is none of at least three of so many points.
void expect_polygons(const Soup& soup, const std::string& name) {
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    const Polygon& polygon = soup.polygons[i];
    if (polygon.size() < 3)
      throw Error(
          fmt::format("{}: found face {} of {} vertices, expected at least 3", name, i + 1, polygon.size()));
    const std::size_t largest = *std::max_element(polygon.begin(), polygon.end());
    if (largest >= soup.points.size())
      throw Error(fmt::format("{}: found vertex {} in face {}, expected 0 to {}", name,
                              static_cast<std::ptrdiff_t>(largest), i + 1, soup.points.size() - 1));
  }
}

Mesh to_mesh(const Soup& soup, const std::string& name) {
  expect_points(soup.points.size(), name);
  expect_finite(soup.points, name);
  expect_polygons(soup, name);
  Mesh mesh;
  for (const Point& p : soup.points) mesh.points.emplace_back(p.x(), p.y(), p.z());
  for (const Polygon& polygon : soup.polygons) {
    const auto vertex = [&](std::size_t i) { return static_cast<int>(polygon[i]); };
    for (std::size_t i = 2; i < polygon.size(); ++i)
      mesh.triangles.push_back({vertex(0), vertex(i - 1), vertex(i)});
  }
  return mesh;
}

/// Reads what has been checked.
template <class Read>
Mesh read_soup(const std::string& plain, const std::string& name, std::string_view format, const Read& read) {
  Soup soup;
  std::istringstream in(plain);
  if (!read(in, soup.points, soup.polygons))
    throw Error(fmt::format("{}: found what CGAL does not read, expected {}", name, format));
  return to_mesh(soup, name);
}

}  // namespace

Mesh parse_off(std::istream& in, const std::string& name) {
  return read_soup(plain_off(read_all(in, name), name), name, "OFF",
                   [](auto&... soup) { return CGAL::IO::read_OFF(soup...); });
}

Mesh parse_ply(std::istream& in, const std::string& name) {
  return read_soup(plain_ply(read_all(in, name), name), name, "PLY",
                   [](auto&... soup) { return CGAL::IO::read_PLY(soup...); });
}

Mesh parse_stl(std::istream& in, const std::string& name) {
  return read_soup(plain_stl(read_all(in, name), name), name, "STL",
                   [](auto&... soup) { return CGAL::IO::read_STL(soup...); });
}

}  // namespace nearmiss
