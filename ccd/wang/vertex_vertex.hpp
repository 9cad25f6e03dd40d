// Vertex-vertex CCD (Algorithm 1).
#pragma once

#include <algorithm>
#include <optional>

#include "ccd/wang/motion.hpp"
#include "ccd/wang/tolerances.hpp"

namespace nearmiss {

/// Algorithm 1: the time at which two vertices are closest, if they are within D at that time. The test is
/// that the computed squared distance is at most D² + δ, and every pair within D passes this test (§4.2). If
/// the vertices do not move relative to each other (v = 0), the time is 0.
template <class T>
std::optional<T> vertex_vertex(const Moving<T>& ji, const Tolerances<T>& tol) {
  using std::clamp;
  const T vv = dot(ji.v(), ji.v());
  const T t = vv > 0 ? clamp(T(-dot(ji.x(), ji.v()) / vv), T(0), T(1)) : T(0);
  const Vector3<T> apart = ji.at(t);
  if (dot(apart, apart) <= tol.D2 + tol.delta) return t;
  return std::nullopt;
}

}  // namespace nearmiss
