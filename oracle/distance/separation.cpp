#include "oracle/distance/separation.hpp"

#include <cmath>
#include <optional>

#include "oracle/arithmetic/guess.hpp"

namespace nearmiss::certified {

namespace {

/// The Bernstein coefficients on [0, end] of a cubic that is not negative at 0. Each coefficient is reduced
/// by a bound of its rounding error.
std::array<double, 4> on(const Powers<double>& cubic, double end) {
  const std::array<double, 4>& p = cubic.c;
  const double p1 = p[1] * end;
  const double p2 = p[2] * end * end;
  const double p3 = p[3] * end * end * end;
  constexpr double rounding = 0x1p-49;
  const double size1 = std::abs(p[0]) + std::abs(p1);
  const double size2 = size1 + std::abs(p2);
  const double size3 = size2 + std::abs(p3);
  return {p[0], p[0] + p1 / 3 - rounding * size1, p[0] + (2 * p1 + p2) / 3 - rounding * size2,
          p[0] + p1 + p2 + p3 - rounding * size3};
}

bool is_not_negative(const std::array<double, 4>& b) {
  return b[0] >= 0 && b[1] >= 0 && b[2] >= 0 && b[3] >= 0;
}

/// An estimate of a root near 0 of a cubic that is positive at 0; usually this is the first root above 0. The
/// result is nothing if some roots are found not to be real.
std::optional<double> first_root(const Powers<double>& p) {
  const auto& [c0, c1, c2, c3] = p.c;
  constexpr double accuracy = 1e-4;
  if (c3 != 0) return root_near_zero(p, accuracy);
  const double discriminant = c1 * c1 - 4 * c0 * c2;
  if (!(discriminant >= 0)) return std::nullopt;
  return 2 * c0 / (std::sqrt(discriminant) - c1);
}

/// A number in [0, most] such that the cubic is certainly not negative from 0 to this number. Usually the
/// number is near the first root, but the search is kept short for speed.
double not_negative_until(const Powers<double>& p, double most) {
  const auto holds_until = [&](double end) { return is_not_negative(on(p, end)); };
  if (!(p.c[0] > 0)) return 0;
  if (holds_until(most)) return most;
  if (const auto root = first_root(p); root && 0 < *root && *root < most) {
    constexpr double less = 1 - 1e-3;
    if (holds_until(*root * less)) return *root * less;
  }
  double end = most;
  constexpr int most_steps = 200;
  for (int i = 0; i < most_steps; ++i) {
    end /= 4;
    if (holds_until(end)) return holds_until(2 * end) ? 2 * end : end;
  }
  return 0;
}

}  // namespace

double certified_reach(const Separation& separation, double distance, int direction, double most) {
  double end = separation.products.empty() ? 0 : most;
  for (const Product& product : separation.products) {
    if (!(end > 0)) break;
    // product - errors - distance |n| as a polynomial in |s|, rounded down.
    Powers<double> excess;
    for (std::size_t i = 0; i < 4; ++i) {
      const double c = product.coefficients[i];
      const double signed_c = i % 2 == 1 && direction < 0 ? -c : c;
      const double needed = product.errors[i] + (i < 3 ? distance * separation.length[i] : 0);
      excess.c[i] = signed_c - needed - 0x1p-50 * (std::abs(signed_c) + needed);
    }
    end = not_negative_until(excess, end);
  }
  return end;
}

}  // namespace nearmiss::certified
