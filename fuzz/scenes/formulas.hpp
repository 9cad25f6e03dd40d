// What scenes made by formula are computed with. Only operations that IEEE 754 rounds in one way, in an order
// that is written down, so that every machine and compiler makes the same bits: no sine of a library, no dot
// product of Eigen's.
#pragma once

#include <array>
#include <cstdint>

#include "ccd/query.hpp"

namespace nearmiss {

/// Cosine and sine of an angle.
struct Direction {
  double cos = 1, sin = 0;
};

/// Of an angle in turns, below 2^40 of them: Taylor's series within an eighth of a turn of the nearest
/// quarter, whose remainder is below 5e-17; off by less than 4e-16. Quarters are exact.
Direction direction(double turns);

/// The larger one of two numbers, without a kink: where they differ by less than `blend` it is up to blend /
/// 4 more.
double smooth_max(double a, double b, double blend);

/// The nearest whole number.
int nearest(double x);

double dot(const Vector3<double>& a, const Vector3<double>& b);
double length(const Vector3<double>& a);

/// A rotation about an axis through the origin; by 0 turns it changes no bit. It is a sum of columns: of x
/// cos - y sin beside x sin + y cos g++ 12 makes fused operations where the processor has them, whatever
/// -ffp-contract says.
class Rotation {
 public:
  Rotation() = default;
  /// `axis` has length 1.
  Rotation(const Vector3<double>& axis, double turns);

  Vector3<double> operator()(const Vector3<double>& p) const;

 private:
  std::array<Vector3<double>, 3> columns_{Vector3<double>{1, 0, 0}, Vector3<double>{0, 1, 0},
                                          Vector3<double>{0, 0, 1}};
};

/// A height over the plane that waves: three plane waves, 6 to 12 edges long, that travel by up to 1/20 of
/// their length from frame to frame.
class Waves {
 public:
  /// Other waves for each stream and index; `height` is that of each of the three.
  Waves(std::uint64_t stream, std::uint64_t index, double height);

  [[nodiscard]] double at(double x, double y, double frame) const;

 private:
  struct Wave {
    double along_x, along_y, by_frame, phase;  ///< in turns
  };
  double height_;
  std::array<Wave, 3> waves_{};
};

}  // namespace nearmiss
