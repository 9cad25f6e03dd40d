// The CCD of a user who tests it with nearmiss. It compares the sign of volume() at both ends of the step, so
// it misses a vertex that passes the triangle's plane twice.
#pragma once

#include <array>

namespace user {

using Point = std::array<double, 3>;

inline Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline double volume(const Point& p, const Point& a, const Point& b, const Point& c) {
  return dot(cross(b - a, c - a), p - a);
}

/// The arguments p0 to c0 are the vertices' positions at t = 0, and p1 to c1 are their positions at t = 1.
inline bool point_triangle_ccd(const Point& p0, const Point& a0, const Point& b0, const Point& c0,
                               const Point& p1, const Point& a1, const Point& b1, const Point& c1) {
  return volume(p0, a0, b0, c0) * volume(p1, a1, b1, c1) <= 0;
}

}  // namespace user
