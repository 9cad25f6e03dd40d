// CCDs as people often write them: they find the roots of the cubic, and test the weights at each root. WAY
// chooses a common mistake.
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ccd/nearmiss_subject.h"

namespace {

using Vector = Eigen::Vector3d;
using Vertices = Eigen::Matrix<double, 3, 4>;  // a column for each vertex

enum Way { NONE, FIRST_ROOT, NO_TOLERANCE, OPEN_END, TWO_EDGES, LINEAR };

using Cubic = std::array<double, 4>;  // coefficient i is that of t^i

double at(const Cubic& f, double t) { return ((f[3] * t + f[2]) * t + f[1]) * t + f[0]; }

/// The determinant of three vectors that move from p, q, r by dp, dq, dr.
Cubic determinant(const Vector& p, const Vector& dp, const Vector& q, const Vector& dq, const Vector& r,
                  const Vector& dr) {
  return {p.dot(q.cross(r)), dp.dot(q.cross(r)) + p.dot(dq.cross(r)) + p.dot(q.cross(dr)),
          dp.dot(dq.cross(r)) + dp.dot(q.cross(dr)) + p.dot(dq.cross(dr)), dp.dot(dq.cross(dr))};
}

/// The roots in [0, 1], between the extrema.
std::vector<double> roots(Cubic f) {
  if (WAY == LINEAR && std::abs(f[3]) < 1e-6) f[3] = f[2] = 0;
  std::vector<double> borders{0, 1};
  const double a = 3 * f[3], b = 2 * f[2], c = f[1], d = b * b - 4 * a * c;
  if (d > 0) {
    const double q = -(b + std::copysign(std::sqrt(d), b)) / 2;
    for (const double t : {q / a, c / q})
      if (t > 0 && t < 1) borders.push_back(t);
  }
  std::sort(borders.begin(), borders.end());
  const double small =
      WAY == NO_TOLERANCE ? 0 : 1e-12 * (std::abs(f[0]) + std::abs(f[1]) + std::abs(f[2]) + std::abs(f[3]));
  std::vector<double> found;
  for (const double t : borders)
    if (std::abs(at(f, t)) <= small) found.push_back(t);
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    double lo = borders[i], hi = borders[i + 1];
    const double sign = at(f, lo);
    if (sign * at(f, hi) >= 0) continue;
    for (int k = 0; k < 60; ++k) (at(f, (lo + hi) / 2) * sign > 0 ? lo : hi) = (lo + hi) / 2;
    found.push_back(hi);
  }
  std::sort(found.begin(), found.end());
  if (WAY == OPEN_END) std::erase_if(found, [](double t) { return t >= 1; });
  return found;
}

double distance(const Vector& p, const Vector& a, const Vector& b) {
  const Vector ab = b - a;
  const double length = ab.squaredNorm();
  const double s = length > 0 ? std::clamp((p - a).dot(ab) / length, 0.0, 1.0) : 0;
  return (a + s * ab - p).norm();
}

bool touches(int kind, const Vertices& v) {
  const bool is_vt = kind == NEARMISS_VERTEX_TRIANGLE;
  const double tolerance =
      WAY == NO_TOLERANCE ? 0 : 1e-8 * (v.rowwise().maxCoeff() - v.rowwise().minCoeff()).norm();
  const auto x = [&](int i) -> Vector { return v.col(i); };
  const Vector r = is_vt ? Vector(x(0) - x(1)) : Vector(x(2) - x(0));
  const Vector p = is_vt ? x(2) - x(1) : x(1) - x(0), q = is_vt ? x(3) - x(1) : x(3) - x(2), n = p.cross(q);
  const double area = n.squaredNorm();
  const double s = n.dot(r.cross(q)), t = is_vt ? n.dot(p.cross(r)) : n.dot(r.cross(p));
  if (area > 0 && s >= 0 && t >= 0 && (is_vt ? s + t <= area : s <= area && t <= area)) return true;
  if (is_vt)
    return distance(x(0), x(1), x(2)) <= tolerance || distance(x(0), x(2), x(3)) <= tolerance ||
           (WAY != TWO_EDGES && distance(x(0), x(3), x(1)) <= tolerance);
  return distance(x(0), x(2), x(3)) <= tolerance || distance(x(1), x(2), x(3)) <= tolerance ||
         distance(x(2), x(0), x(1)) <= tolerance || distance(x(3), x(0), x(1)) <= tolerance;
}

bool collides(int kind, const Vertices& start, const Vertices& end) {
  const auto span = [&](const Vertices& v, int i) -> Vector { return v.col(i) - v.col(0); };
  const auto moves = [&](int i) -> Vector { return span(end, i) - span(start, i); };
  const Cubic f = determinant(span(start, 1), moves(1), span(start, 2), moves(2), span(start, 3), moves(3));
  for (const double t : roots(f)) {
    if (touches(kind, (1 - t) * start + t * end)) return true;
    if (WAY == FIRST_ROOT && kind == NEARMISS_VERTEX_TRIANGLE) return false;
  }
  return false;
}

void decide(void*, int kind, std::size_t n, const double* x, const double*, int* answer, double*) {
  for (std::size_t i = 0; i < n; ++i)
    answer[i] =
        collides(kind, Eigen::Map<const Vertices>(x + 24 * i), Eigen::Map<const Vertices>(x + 24 * i + 12));
}

}  // namespace

const nearmiss_subject* nearmiss_get_subject(std::size_t index) {
  static const nearmiss_subject subject = [] {
    nearmiss_subject made{};
    made.interface_version = NEARMISS_INTERFACE;
    made.name = "mine";
    made.kinds = NEARMISS_VERTEX_TRIANGLE + NEARMISS_EDGE_EDGE;
    made.batch = 4096;
    made.decide = decide;
    return made;
  }();
  return index == 0 ? &subject : nullptr;
}
