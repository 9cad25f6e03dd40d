// The oracle, with the interface that contact codes use for CCD: the functions take the positions of all
// points at the start and the end of the step, a minimum distance and the largest time, and give a time of
// impact. nearmiss::ExactCCD can replace a class whose functions have the names and arguments below. C++20.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "oracle/interface/nearmiss.hpp"

namespace nearmiss {

/// Exact CCD. Every function returns whether the distance of its two primitives is at most `min_distance` at
/// some t in [0, tmax], and sets `toi` to the largest double that is not after the first such t. So the
/// distance is above `min_distance` in [0, toi), and `toi` need not be scaled down. If there is no such t,
/// `toi` is infinite. If a coordinate is not finite, `min_distance` is negative, or `tmax` is above 1, the
/// functions report a collision with toi = 0, because a simulation must not take that step.
///
/// A point may be of any type that gives its coordinates by operator[] or operator(). A point has three
/// coordinates; if its size() is 2, the third coordinate is taken to be 0.
class ExactCCD {
 public:
  /// A point and a triangle.
  bool point_triangle_ccd(const auto& p_t0, const auto& t0_t0, const auto& t1_t0, const auto& t2_t0,
                          const auto& p_t1, const auto& t0_t1, const auto& t1_t1, const auto& t2_t1,
                          double& toi, double min_distance = 0, double tmax = 1) const noexcept {
    return first_contact(Kind::vertex_triangle, toi, min_distance, tmax, p_t0, t0_t0, t1_t0, t2_t0, p_t1,
                         t0_t1, t1_t1, t2_t1);
  }

  /// Two edges.
  bool edge_edge_ccd(const auto& ea0_t0, const auto& ea1_t0, const auto& eb0_t0, const auto& eb1_t0,
                     const auto& ea0_t1, const auto& ea1_t1, const auto& eb0_t1, const auto& eb1_t1,
                     double& toi, double min_distance = 0, double tmax = 1) const noexcept {
    return first_contact(Kind::edge_edge, toi, min_distance, tmax, ea0_t0, ea1_t0, eb0_t0, eb1_t0, ea0_t1,
                         ea1_t1, eb0_t1, eb1_t1);
  }

  /// A point and an edge.
  bool point_edge_ccd(const auto& p_t0, const auto& e0_t0, const auto& e1_t0, const auto& p_t1,
                      const auto& e0_t1, const auto& e1_t1, double& toi, double min_distance = 0,
                      double tmax = 1) const noexcept {
    return first_contact(Kind::vertex_edge, toi, min_distance, tmax, p_t0, e0_t0, e1_t0, p_t1, e0_t1, e1_t1);
  }

  /// Two points.
  bool point_point_ccd(const auto& p0_t0, const auto& p1_t0, const auto& p0_t1, const auto& p1_t1,
                       double& toi, double min_distance = 0, double tmax = 1) const noexcept {
    return first_contact(Kind::vertex_vertex, toi, min_distance, tmax, p0_t0, p1_t0, p0_t1, p1_t1);
  }

 private:
  /// Converts a float to double exactly, even if the processor treats subnormal floats as 0. NaN and
  /// -infinity become infinity.
  static double widened_float(float x) {
    const auto bits = std::bit_cast<std::uint32_t>(x);
    constexpr std::uint32_t exponent = 0x7f800000;
    if ((bits & exponent) == exponent) return std::bit_cast<double>(std::uint64_t{0x7ff} << 52);
    if ((bits & exponent) != 0) return double{x};
    const double magnitude = static_cast<double>(bits & 0x7fffff) * 0x1p-149;
    return bits >> 31 == 0 ? magnitude : -magnitude;
  }

  template <class Number>
  static double widened(const Number& x) {
    if constexpr (std::is_same_v<Number, float>)
      return widened_float(x);
    else
      return static_cast<double>(x);
  }

  template <int k>
  static double coordinate(const auto& point) {
    if constexpr (requires { point.size(); })
      if (static_cast<int>(point.size()) <= k) return 0;
    if constexpr (requires { point(k); })
      return widened(point(k));
    else
      return widened(point[k]);
  }

  static bool first_contact(Kind kind, double& toi, double min_distance, double tmax,
                            const auto&... points) noexcept {
    std::array<double, 3 * sizeof...(points)> x;
    std::size_t next = 0;
    const auto add = [&](const auto& point) {
      x[next++] = coordinate<0>(point);
      x[next++] = coordinate<1>(point);
      x[next++] = coordinate<2>(point);
    };
    (add(points), ...);
    const Queries query = Queries::packed(kind, x).with_separation(min_distance);
    std::int8_t answer = NEARMISS_NO_ANSWER;
    toi = 0;
    (void)times_of_impact(query, {&answer, 1}, {&toi, 1}, tmax);
    return Answer{answer} != Answer::no_collision;
  }
};

}  // namespace nearmiss
