// A complete example of a plug-in in C++ with Eigen. It samples the motion, and reports a query if the
// primitives are within a tolerance of each other at some sample. The time of impact is the time of the first
// such sample. The plug-in misses collisions between samples.
//
//   c++ -std=c++17 -O2 -shared -fPIC -I. -isystem /usr/include/eigen3 tests/plugin/example.cpp -o sampling.so
//   build/release/nearmiss fuzz --subject ./sampling.so:tolerance=0.01 --cases 100000
#include <Eigen/Geometry>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

#include "ccd/nearmiss_subject.h"

namespace {

using Vector = Eigen::Vector3d;
using Vertices = Eigen::Matrix<double, 3, 4>;  // a column for each vertex

/// The detector's state. Each thread has its own.
struct Sampling {
  double tolerance = 1e-3;
};

double distance(const Vector& p, const Vector& a, const Vector& b) {
  const Vector ab = b - a;
  const double length = ab.squaredNorm();
  const double s = length > 0 ? std::clamp((p - a).dot(ab) / length, 0.0, 1.0) : 0;
  return (a + s * ab - p).norm();
}

double vertex_triangle_distance(const Vertices& v) {
  const Vector p = v.col(0), a = v.col(1), q = v.col(2) - a, r = v.col(3) - a, n = q.cross(r);
  const double area = n.squaredNorm();
  const double beta = n.dot((p - a).cross(r)), gamma = n.dot(q.cross(p - a));
  if (area > 0 && beta >= 0 && gamma >= 0 && beta + gamma <= area) return std::abs(n.dot(p - a)) / n.norm();
  return std::min(
      {distance(p, v.col(1), v.col(2)), distance(p, v.col(2), v.col(3)), distance(p, v.col(3), v.col(1))});
}

double edge_edge_distance(const Vertices& v) {
  const Vector a = v.col(0), c = v.col(2), d = v.col(1) - a, e = v.col(3) - c, n = d.cross(e);
  const double area = n.squaredNorm();
  const double s = (c - a).cross(e).dot(n), t = (c - a).cross(d).dot(n);
  if (area > 0 && s >= 0 && s <= area && t >= 0 && t <= area) return std::abs(n.dot(c - a)) / n.norm();
  return std::min({distance(v.col(0), v.col(2), v.col(3)), distance(v.col(1), v.col(2), v.col(3)),
                   distance(v.col(2), v.col(0), v.col(1)), distance(v.col(3), v.col(0), v.col(1))});
}

void* open_sampling(const char* options, char* message, std::size_t size) {
  const std::string text(options);
  double tolerance = Sampling().tolerance;
  if (!text.empty() && (std::sscanf(options, "tolerance=%lf", &tolerance) != 1 || !(tolerance >= 0))) {
    std::snprintf(message, size, "expected tolerance=LENGTH");
    return nullptr;
  }
  return new Sampling{tolerance};
}

void close_sampling(void* state) { delete static_cast<Sampling*>(state); }

void decide(void* state, int kind, std::size_t n, const double* x, const double* /*h*/, int* answer,
            double* toi) {
  constexpr int samples = 64;
  const double tolerance = static_cast<const Sampling*>(state)->tolerance;
  for (std::size_t i = 0; i < n; ++i) {
    const Vertices start = Eigen::Map<const Vertices>(x + 24 * i),
                   end = Eigen::Map<const Vertices>(x + 24 * i + 12);
    answer[i] = NEARMISS_NO_COLLISION;
    for (int k = 0; k <= samples && answer[i] == NEARMISS_NO_COLLISION; ++k) {
      const double t = static_cast<double>(k) / samples;
      const Vertices now = (1 - t) * start + t * end;
      if ((kind == NEARMISS_VERTEX_TRIANGLE ? vertex_triangle_distance(now) : edge_edge_distance(now)) >
          tolerance)
        continue;
      answer[i] = NEARMISS_COLLISION;
      toi[i] = t;
    }
  }
}

nearmiss_subject sampling() {
  nearmiss_subject subject{};
  subject.interface_version = NEARMISS_INTERFACE;
  subject.name = "sampling";
  subject.version = "1.0";
  subject.about = "whether the primitives are close at one of 65 times; tolerance=LENGTH";
  subject.kinds = NEARMISS_VERTEX_TRIANGLE + NEARMISS_EDGE_EDGE;
  subject.time_sort = NEARMISS_TIME_ESTIMATE;
  subject.open = open_sampling;
  subject.close = close_sampling;
  subject.decide = decide;
  return subject;
}

}  // namespace

const nearmiss_subject* nearmiss_get_subject(std::size_t index) {
  static const nearmiss_subject subject = sampling();
  return index == 0 ? &subject : nullptr;
}
