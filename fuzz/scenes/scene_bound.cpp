#include "fuzz/scenes/scene_bound.hpp"

#include <algorithm>
#include <cmath>

#include "ccd/wang/pair_bound.hpp"
#include "fuzz/scenes/candidates.hpp"

namespace nearmiss {

double scene_bound(const Scene& scene) {
  double largest = 0;
  for_each_step(scene, never_over, [&](std::size_t, const MovingMesh& mesh) {
    const auto take = [&](const Candidate& candidate) {
      largest = std::max(largest, pair_bound(make_query(mesh, candidate)));
    };
    find_candidates(mesh, take);
  });
  const double unit = std::pow(10, std::floor(std::log10(largest)) - 3);
  const double rounded = std::ceil(largest / unit) * unit;
  return rounded >= largest && std::isfinite(rounded) ? rounded : largest;
}

}  // namespace nearmiss
