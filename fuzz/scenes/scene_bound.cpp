#include "fuzz/scenes/scene_bound.hpp"

#include <algorithm>
#include <cmath>

#include "ccd/wang/pair_bound.hpp"
#include "fuzz/scenes/candidates.hpp"

namespace nearmiss {

double scene_bound(const Scene& scene, const Stop& stop) {
  const IsOver is_over = [&] { return stop.is_due(); };
  double largest = 0;
  for_each_step(scene, is_over, [&](std::size_t, const MovingMesh& mesh) {
    const auto take = [&](const Candidate& candidate) {
      largest = std::max(largest, pair_bound(make_query(mesh, candidate)));
    };
    find_candidates(mesh, take, is_over);
  });
  stop.check();
  const double unit = std::pow(10, std::floor(std::log10(largest)) - 3);
  const double rounded = std::ceil(largest / unit) * unit;
  return rounded >= largest && std::isfinite(rounded) ? rounded : largest;
}

}  // namespace nearmiss
