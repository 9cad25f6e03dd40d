// Implements the CCD interface of the ipc-toolkit (its base class, from the headers of additive CCD) with the
// oracle. Calls it as the toolkit's contact code does: with Eigen's vectors, in space and in the plane.
#include <Eigen/Core>
#include <cmath>
#include <cstdio>
#include <ipc/ccd/narrow_phase_ccd.hpp>
#include <nearmiss/contact.hpp>

namespace {

class Exact final : public ipc::NarrowPhaseCCD {
  using Point = Eigen::ConstRef<Eigen::Vector3d>;
  using AnyPoint = Eigen::ConstRef<ipc::VectorMax3d>;

 public:
  bool point_point_ccd(AnyPoint a0, AnyPoint b0, AnyPoint a1, AnyPoint b1, double& toi,
                       const double min_distance, const double tmax) const override {
    return ccd_.point_point_ccd(a0, b0, a1, b1, toi, min_distance, tmax);
  }
  bool point_edge_ccd(AnyPoint p0, AnyPoint a0, AnyPoint b0, AnyPoint p1, AnyPoint a1, AnyPoint b1,
                      double& toi, const double min_distance, const double tmax) const override {
    return ccd_.point_edge_ccd(p0, a0, b0, p1, a1, b1, toi, min_distance, tmax);
  }
  bool point_triangle_ccd(Point p0, Point a0, Point b0, Point c0, Point p1, Point a1, Point b1, Point c1,
                          double& toi, const double min_distance, const double tmax) const override {
    return ccd_.point_triangle_ccd(p0, a0, b0, c0, p1, a1, b1, c1, toi, min_distance, tmax);
  }
  bool edge_edge_ccd(Point a0, Point b0, Point c0, Point d0, Point a1, Point b1, Point c1, Point d1,
                     double& toi, const double min_distance, const double tmax) const override {
    return ccd_.edge_edge_ccd(a0, b0, c0, d0, a1, b1, c1, d1, toi, min_distance, tmax);
  }

 private:
  nearmiss::ExactCCD ccd_;
};

}  // namespace

int main() {
  const Exact exact{};
  const ipc::NarrowPhaseCCD& ccd = exact;
  const Eigen::Vector3d a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), above(0.25, 0.25, 1), below(0.25, 0.25, -1);
  Eigen::MatrixXd rows(2, 3);
  rows << 0.25, 0.25, 1, 0.25, 0.25, -1;
  int failures = 0;
  const auto expect = [&](bool holds, const char* what) {
    if (!holds && ++failures) std::fprintf(stderr, "%s\n", what);
  };
  double toi = 7;
  expect(ccd.point_triangle_ccd(above, a, b, c, below, a, b, c, toi) && toi == 0.5, "point_triangle_ccd");
  expect(
      ccd.point_triangle_ccd(rows.row(0).transpose(), a, b, c, rows.row(1).transpose(), a, b, c, toi, 0.5) &&
          toi == 0.25,
      "rows of a matrix, with a minimum distance");
  expect(!ccd.point_triangle_ccd(above, a, b, c, below, a, b, c, toi, 0, 0.25),
         "point_triangle_ccd until 0.25");
  const Eigen::Vector3d p(-1, 0, 1), q(1, 0, 1), r(0, -1, 0), s(0, 1, 0), p1(-1, 0, -3), q1(1, 0, -3);
  expect(ccd.edge_edge_ccd(p, q, r, s, p1, q1, r, s, toi) && toi == 0.25, "edge_edge_ccd");
  const Eigen::Vector2d u(0, 1), v(-1, 0), w(1, 0), u1(0, -1);
  expect(ccd.point_edge_ccd(u, v, w, u1, v, w, toi) && toi == 0.5, "point_edge_ccd in the plane");
  expect(ccd.point_point_ccd(u, v, v, u, toi) && toi == 0.5, "point_point_ccd in the plane");
  std::printf("additive: %d failures\n", failures);
  return failures == 0 ? 0 : 1;
}
