#include "fuzz/scenes/built_in/formulas.hpp"

#include <algorithm>
#include <cmath>

#include "fuzz/random.hpp"

namespace nearmiss {

CosSin cos_sin(double turns) {
  constexpr double radians_of_a_turn = 6.283185307179586;
  const double quarters = std::floor(4 * turns + 0.5);
  const double x = (turns - quarters / 4) * radians_of_a_turn;
  const double xx = x * x;
  double sin = 1;
  double cos = 1;
  for (int k = 16; k >= 2; k -= 2) {
    sin = 1 - sin * xx / (k * (k + 1));
    cos = 1 - cos * xx / (k * (k - 1));
  }
  sin = sin * x;
  switch (static_cast<int>(quarters - 4 * std::floor(quarters / 4))) {
    case 0:
      return {cos, sin};
    case 1:
      return {-sin, cos};
    case 2:
      return {-cos, -sin};
    default:
      return {sin, -cos};
  }
}

double smooth_max(double a, double b, double blend) {
  const double near = std::max(blend - std::abs(a - b), 0.0) / blend;
  return std::max(a, b) + near * near * blend / 4;
}

int nearest(double x) { return static_cast<int>(std::floor(x + 0.5)); }

double dot(const Vector3<double>& a, const Vector3<double>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double length(const Vector3<double>& a) { return std::sqrt(dot(a, a)); }

Rotation::Rotation(const Vector3<double>& axis, double turns) {
  const CosSin angle = cos_sin(turns);
  for (int i = 0; i < 3; ++i) {  // Rodrigues' formula gives the images of the three unit vectors
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    auto& column = columns_[static_cast<std::size_t>(i)];
    const double along = (1 - angle.cos) * axis[i];
    column[i] = angle.cos + along * axis[i];
    column[j] = along * axis[j] + angle.sin * axis[k];
    column[k] = along * axis[k] - angle.sin * axis[j];
  }
}

Vector3<double> Rotation::operator()(const Vector3<double>& p) const {
  return columns_[0] * p[0] + columns_[1] * p[1] + columns_[2] * p[2];
}

Waves::Waves(std::uint64_t stream, std::uint64_t index, double height) : height_(height) {
  Random random(0, stream, index);
  for (Wave& wave : waves_) {
    const CosSin way = cos_sin(random.uniform());
    const double edges = random.uniform(6, 12);
    wave.along_x = way.cos / edges;
    wave.along_y = way.sin / edges;
    wave.by_frame = random.uniform(-0.05, 0.05);
    wave.phase = random.uniform();
  }
}

double Waves::at(double x, double y, double frame) const {
  double sum = 0;
  for (const Wave& wave : waves_)
    sum += cos_sin(wave.along_x * x + wave.along_y * y + wave.by_frame * frame + wave.phase).sin;
  return height_ * sum;
}

}  // namespace nearmiss
