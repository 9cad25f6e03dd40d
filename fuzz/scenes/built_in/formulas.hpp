// The functions that compute built-in scenes. They only use operations whose rounding IEEE 754 prescribes, in
// a fixed order, so that every machine and compiler gives the same bits. So they use neither a library's sine
// nor Eigen's dot product.
#pragma once

#include <array>
#include <cstdint>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// Cosine and sine of an angle.
struct CosSin {
  double cos = 1, sin = 0;
};

/// Cosine and sine of an angle of less than 2^40 turns, with errors below 4e-16; multiples of a quarter turn
/// are exact. It uses the Taylor series around the nearest quarter turn, at most an eighth of a turn away,
/// with a remainder below 5e-17.
CosSin cos_sin(double turns);

/// The maximum of two numbers, smoothed: if they differ by less than `blend`, the result is larger by up to
/// blend / 4.
double smooth_max(double a, double b, double blend);

/// The nearest integer.
int nearest(double x);

double dot(const Vector3<double>& a, const Vector3<double>& b);
double length(const Vector3<double>& a);

/// A rotation about an axis through the origin. A rotation by 0 turns changes no bit. It is computed as a sum
/// of columns. If x cos - y sin and x sin + y cos were computed side by side, g++ 12 would use fused
/// operations where the processor has them, even with -ffp-contract=off.
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
  /// Each stream and index gives different waves; `height` is the height of each of the three waves.
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
