// A small library such as users have. It offers a CCD through each function signature that
// ccd/nearmiss_functions.hpp knows, and with several types of vectors. The CCD advances to the earliest time
// at which the axis-aligned boxes of the two primitives may be as close as the separation. So it misses
// nothing, and never gives a late time. It also reports pairs whose boxes meet although the primitives do
// not, and pairs that need 100 steps.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace foreign {

/// Decides a pair. x has the vertices at t = 0, and then the same vertices at t = 1. The first `split`
/// vertices belong to the first primitive.
bool advance(const std::vector<std::array<double, 3>>& x, int split, double h, double& toi);

template <class... V>
bool meet(int split, double h, double& toi, const V&... v) {
  return advance({{{v[0], v[1], v[2]}}...}, split, h, toi);
}

namespace ipc {  // overloads, default arguments, and Eigen's references, some of dynamic size

using Point = const Eigen::Ref<const Eigen::Vector3d>&;
using Any = const Eigen::Ref<const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>>&;

class Narrow {
 public:
  bool point_triangle_ccd(Point p, Point a, Point b, Point c, Point p1, Point a1, Point b1, Point c1,
                          double& toi, double min_distance = 0, double tmax = 1, long iterations = -1) const {
    return iterations == -1 && tmax == 1 && meet(1, min_distance, toi, p, a, b, c, p1, a1, b1, c1);
  }
  bool edge_edge_ccd(Point a, Point b, Point c, Point d, Point a1, Point b1, Point c1, Point d1, double& toi,
                     double min_distance = 0, double tmax = 1) const {
    return tmax == 1 && meet(2, min_distance, toi, a, b, c, d, a1, b1, c1, d1);
  }
  bool point_edge_ccd(Any p, Any a, Any b, Any p1, Any a1, Any b1, double& toi, double min_distance = 0,
                      double tmax = 1) const {
    return tmax == 1 && meet(1, min_distance, toi, p, a, b, p1, a1, b1);
  }
  bool point_point_ccd(Any a, Any b, Any a1, Any b1, double& toi, double min_distance = 0,
                       double tmax = 1) const {
    return tmax == 1 && meet(1, min_distance, toi, a, b, a1, b1);
  }
};

}  // namespace ipc

namespace accd {  // templates whose arguments are displacements; on entry, toc is the end of the time step

template <class T>
bool Point_Triangle_CCD(Eigen::Matrix<T, 3, 1> p, Eigen::Matrix<T, 3, 1> a, Eigen::Matrix<T, 3, 1> b,
                        Eigen::Matrix<T, 3, 1> c, Eigen::Matrix<T, 3, 1> dp, Eigen::Matrix<T, 3, 1> da,
                        Eigen::Matrix<T, 3, 1> db, Eigen::Matrix<T, 3, 1> dc, T eta, T thickness, T& toc) {
  dp += p, da += a, db += b, dc += c;
  return eta > 0 && toc == 1 && meet(1, thickness, toc, p, a, b, c, dp, da, db, dc);
}
template <class T>
bool Edge_Edge_CCD(Eigen::Matrix<T, 3, 1> a, Eigen::Matrix<T, 3, 1> b, Eigen::Matrix<T, 3, 1> c,
                   Eigen::Matrix<T, 3, 1> d, Eigen::Matrix<T, 3, 1> da, Eigen::Matrix<T, 3, 1> db,
                   Eigen::Matrix<T, 3, 1> dc, Eigen::Matrix<T, 3, 1> dd, T eta, T thickness, T& toc) {
  da += a, db += b, dc += c, dd += d;
  return eta > 0 && toc == 1 && meet(2, thickness, toc, a, b, c, d, da, db, dc, dd);
}

}  // namespace accd

struct CTCD {
  using V = const Eigen::Vector3d&;
  static bool vertexFaceCTCD(V p, V a, V b, V c, V p1, V a1, V b1, V c1, double eta, double& t) {
    return meet(1, eta, t, p, a, b, c, p1, a1, b1, c1);
  }
  static bool edgeEdgeCTCD(V a, V b, V c, V d, V a1, V b1, V c1, V d1, double eta, double& t) {
    return meet(2, eta, t, a, b, c, d, a1, b1, c1, d1);
  }
};

namespace eltopo {  // each vertex is passed with its new position and index; one function has two overloads

struct Vec3d {
  double v[3];
  explicit Vec3d(double all) : v{all, all, all} {}
  template <class S>
  explicit Vec3d(const S* source) : v{source[0], source[1], source[2]} {}
  Vec3d(double x, double y, double z) : v{x, y, z} {}
  double operator[](std::size_t i) const { return v[i]; }
};
using V = const Vec3d&;
using I = std::size_t;

inline bool point_triangle_collision(V p, V p1, I i, V a, V a1, I j, V b, V b1, I k, V c, V c1, I l) {
  double t = 0;
  return i < j && j < k && k < l && meet(1, 0, t, p, a, b, c, p1, a1, b1, c1);
}
bool point_triangle_collision(V p, V p1, I i, V a, V a1, I j, V b, V b1, I k, V c, V c1, I l, double& bary,
                              Vec3d& normal);
inline bool segment_segment_collision(V a, V a1, I i, V b, V b1, I j, V c, V c1, I k, V d, V d1, I l) {
  double t = 0;
  return i < j && j < k && k < l && meet(2, 0, t, a, b, c, d, a1, b1, c1, d1);
}

}  // namespace eltopo

namespace plain {

using P = const double*;
inline int vertex_triangle(P p, P a, P b, P c, P p1, P a1, P b1, P c1) {
  double t = 0;
  return meet(1, 0, t, p, a, b, c, p1, a1, b1, c1) ? 1 : 0;
}

using A = std::array<double, 3>;
inline bool edge_edge(A a, A b, A c, A d, A a1, A b1, A c1, A d1, double& toi) {
  return meet(2, 0, toi, a, b, c, d, a1, b1, c1, d1);
}

struct Float3 {
  float x, y, z;
  float operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
};
inline bool vertex_vertex(Float3 a, Float3 b, Float3 a1, Float3 b1, double& toi) {
  return meet(1, 0, toi, a, b, a1, b1);
}

}  // namespace plain

/// This function is declared, but never defined.
bool forgotten(plain::P, plain::P, plain::P, plain::P, plain::P, plain::P, plain::P, plain::P);

namespace distances {  // distances of primitives at rest; the second function has a default argument

inline double vertex_vertex(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return (a - b).norm(); }
inline double vertex_edge_squared(Eigen::Vector3d p, Eigen::Vector3d a, Eigen::Vector3d b, double scale = 1) {
  const Eigen::Vector3d edge = b - a;
  const double length = edge.squaredNorm(), along = (p - a).dot(edge);
  const double t = along <= 0 || length == 0 ? 0 : along >= length ? 1 : along / length;
  return scale * (p - a - t * edge).squaredNorm();
}

}  // namespace distances

}  // namespace foreign
