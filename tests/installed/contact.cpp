// Calls the oracle in the way in which a contact code calls its CCD, and with the types of points that
// contact codes use.
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nearmiss/contact.hpp>

namespace {

int failures = 0;

void expect(bool holds, const char* what) {
  if (holds) return;
  ++failures;
  std::fprintf(stderr, "%s\n", what);
}

using Point = std::array<double, 3>;

struct Flat {  // a point in the plane, of floats
  float x, y;
  float operator()(std::ptrdiff_t k) const { return k == 0 ? x : y; }
  static int size() { return 2; }
};

}  // namespace

int main() {
  const nearmiss::ExactCCD ccd;
  const Point a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, above{0.25, 0.25, 1}, below{0.25, 0.25, -1};
  double toi = 7;
  expect(ccd.point_triangle_ccd(above, a, b, c, below, a, b, c, toi) && toi == 0.5,
         "a vertex meets a triangle at 0.5");
  expect(ccd.point_triangle_ccd(above, a, b, c, below, a, b, c, toi, 0.5) && toi == 0.25,
         "comes within 0.5 at 0.25");
  expect(ccd.point_triangle_ccd(above, a, b, c, below, a, b, c, toi, 0, 0.5) && toi == 0.5,
         "meets in [0, 0.5]");
  expect(!ccd.point_triangle_ccd(above, a, b, c, below, a, b, c, toi, 0, std::nextafter(0.5, 0.0)) && toi > 1,
         "does not meet before 0.5");
  expect(!ccd.point_triangle_ccd(above, a, b, c, above, a, b, c, toi), "does not move");

  // The exact time is 1/3, which is not a double.
  const Point high{0.25, 0.25, 1}, low{0.25, 0.25, -2};
  expect(ccd.point_triangle_ccd(high, a, b, c, low, a, b, c, toi) && toi == 1. / 3, "at 1/3");
  const double before = toi, after = std::nextafter(toi, 1.0);
  expect(!ccd.point_triangle_ccd(high, a, b, c, low, a, b, c, toi, 0, before), "not before 1/3");
  expect(ccd.point_triangle_ccd(high, a, b, c, low, a, b, c, toi, 0, after) && toi == before,
         "until the double after 1/3");

  const Point p{-1, 0, 1}, q{1, 0, 1}, r{0, -1, 0}, s{0, 1, 0}, p1{-1, 0, -3}, q1{1, 0, -3};
  expect(ccd.edge_edge_ccd(p, q, r, s, p1, q1, r, s, toi) && toi == 0.25, "two edges meet");
  expect(ccd.edge_edge_ccd(p, q, r, s, p1, q1, r, s, toi, 1), "two edges are near from the start");
  expect(toi == 0, "at the start");
  expect(ccd.point_edge_ccd(above, a, b, below, a, b, toi, 0.25) && toi == 0.5,
         "a vertex comes within 0.25 of an edge");
  expect(ccd.point_point_ccd(above, a, Point{0, 0, -1}, a, toi, 0.1875), "two vertices come near");
  expect(!ccd.point_point_ccd(above, a, Point{0.25, 0.25, -1}, a, toi, 0.1875), "two vertices do not");
  const Flat u{0, 1}, v{-1, 0}, w{1, 0}, u1{0, -1};
  expect(ccd.point_edge_ccd(u, v, w, u1, v, w, toi) && toi == 0.5, "in the plane");

  // With -ffast-math, the processor takes subnormal numbers for 0. Even then, the answer must be that the
  // vertex, which moves from `tiny` to `tinier`, does not touch the triangle.
  using Small = std::array<float, 3>;
  const Small tiny{0.25F, 0.25F, 1e-40F}, tinier{0.25F, 0.25F, 2e-40F}, fa{0, 0, 0}, fb{1, 0, 0}, fc{0, 1, 0};
  expect(!ccd.point_triangle_ccd(tiny, fa, fb, fc, tinier, fa, fb, fc, toi), "subnormal floats");
  using Grid = std::array<int, 3>;
  const Grid ga{0, 0, 0}, gb{4, 0, 0}, gc{0, 4, 0}, high_up{1, 1, 1}, low_down{1, 1, -1};
  expect(ccd.point_triangle_ccd(high_up, ga, gb, gc, low_down, ga, gb, gc, toi) && toi == 0.5,
         "whole numbers");
  const double* const raw = above.data();
  expect(ccd.point_triangle_ccd(raw, fa, b, fc, below, a, fb, c, toi) && toi == 0.5,
         "points of several types");

  // If the oracle gives no answer, the functions report a collision, so that a simulation does not advance
  // past a possible contact.
  const Point nowhere{std::numeric_limits<double>::quiet_NaN(), 0, 0};
  expect(ccd.point_triangle_ccd(nowhere, a, b, c, below, a, b, c, toi) && toi == 0, "not a number");
  expect(ccd.point_triangle_ccd(above, a, b, c, above, a, b, c, toi, -1) && toi == 0, "a negative distance");
  std::printf("contact: %d failures\n", failures);
  return failures == 0 ? 0 : 1;
}
