// Vectors of three numbers of any type.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace nearmiss::certified {

template <class Real>
using Vec = std::array<Real, 3>;

template <class Real>
Vec<Real> operator+(const Vec<Real>& v, const Vec<Real>& w) {
  return {v[0] + w[0], v[1] + w[1], v[2] + w[2]};
}
template <class Real>
Vec<Real> operator-(const Vec<Real>& v, const Vec<Real>& w) {
  return {v[0] - w[0], v[1] - w[1], v[2] - w[2]};
}
template <class Real>
Vec<Real> operator-(const Vec<Real>& v) {
  return {-v[0], -v[1], -v[2]};
}
template <class Real>
Vec<Real> operator*(const Real& factor, const Vec<Real>& v) {
  return {factor * v[0], factor * v[1], factor * v[2]};
}
template <class Real>
Real dot(const Vec<Real>& v, const Vec<Real>& w) {
  return v[0] * w[0] + v[1] * w[1] + v[2] * w[2];
}
template <class Real>
Real cross_component(const Vec<Real>& v, const Vec<Real>& w, std::size_t k) {
  const std::size_t i = (k + 1) % 3;
  const std::size_t j = (k + 2) % 3;
  return v[i] * w[j] - v[j] * w[i];
}
template <class Real>
Vec<Real> cross(const Vec<Real>& v, const Vec<Real>& w) {
  return {cross_component(v, w, 0), cross_component(v, w, 1), cross_component(v, w, 2)};
}

inline double length(const Vec<double>& v) { return std::sqrt(dot(v, v)); }

/// A double that approximates x with a relative error of at most 2^-53; x itself if it is a double.
template <class Real>
double to_double(const Real& x) {
  return static_cast<double>(x);
}
template <class Real>
Vec<double> to_double(const Vec<Real>& v) {
  return {to_double(v[0]), to_double(v[1]), to_double(v[2])};
}
template <class Real>
Vec<Real> of_double(const Vec<double>& v) {
  return {Real(v[0]), Real(v[1]), Real(v[2])};
}

}  // namespace nearmiss::certified
