// The vertices of a query as Eigen's vectors.
#pragma once

#include <Eigen/Core>

#include <array>

#include "fuzz/subjects/peers/adapter.hpp"

namespace nearmiss::peers {

/// Calls act(start 0, ..., start 3, end 0, ..., end 3).
template <class Act>
auto with_vectors(const Question& q, const Act& act) {
  std::array<Eigen::Vector3d, 8> v;
  for (int i = 0; i < 4; ++i) {
    v[static_cast<std::size_t>(i)] = Eigen::Map<const Eigen::Vector3d>(q.start(i));
    v[static_cast<std::size_t>(i) + 4] = Eigen::Map<const Eigen::Vector3d>(q.end(i));
  }
  return act(v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]);
}

}  // namespace nearmiss::peers
