// The functions that compute built-in scenes. Every machine and compiler must give the same bits. So these
// functions use only operations whose rounding IEEE 754 prescribes, in a fixed order. The sine of a C library
// may be rounded in another way on another machine, and Eigen's dot product may add its terms in another
// order.
#pragma once

#include <array>
#include <cstdint>

#include "ccd/query/query.hpp"

namespace nearmiss {

struct CosSin {
  double cos = 1, sin = 0;
};

/// Cosine and sine of an angle of less than 2^40 turns, with errors below 4e-16; the results for multiples of
/// a quarter turn are exact. The results come from the Taylor series around the nearest quarter turn, which
/// is at most an eighth of a turn away. The remainder of the series is below 5e-17.
CosSin cos_sin(double turns);

/// The smoothed maximum of two numbers. If they differ by less than `blend`, the result exceeds the maximum
/// by up to blend / 4.
double smooth_max(double a, double b, double blend);

/// The nearest integer.
int nearest(double x);

double dot(const Vector3<double>& a, const Vector3<double>& b);
double length(const Vector3<double>& a);

/// A rotation about an axis through the origin. A rotation by 0 turns changes no bit. The image of a point is
/// computed as a sum of columns of the rotation matrix. The rows, such as x cos - y sin and x sin + y cos,
/// are not computed one by one: g++ 12 would use fused operations for them if the processor has such
/// operations, even with -ffp-contract=off.
class Rotation {
 public:
  Rotation() = default;
  /// `axis` must have length 1.
  Rotation(const Vector3<double>& axis, double turns);

  Vector3<double> operator()(const Vector3<double>& p) const;

 private:
  std::array<Vector3<double>, 3> columns_{Vector3<double>{1, 0, 0}, Vector3<double>{0, 1, 0},
                                          Vector3<double>{0, 0, 1}};
};

/// The height of a waving surface: the sum of three plane waves, 6 to 12 edges long, that travel by up to
/// 1/20 of their length from frame to frame.
class Waves {
 public:
  /// Three waves of the given height. Each pair of stream and index gives different waves.
  Waves(std::uint64_t stream, std::uint64_t index, double height);

  [[nodiscard]] double at(double x, double y, double frame) const;

 private:
  struct Wave {
    double along_x, along_y, by_frame, phase;  ///< all in turns
  };
  double height_;
  std::array<Wave, 3> waves_{};
};

}  // namespace nearmiss
