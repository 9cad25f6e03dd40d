// Counts how far random pairs get in the algorithms of Wang's paper.
#pragma once

#include <cstdint>

#include "ccd/query/query.hpp"
#include "fuzz/stop.hpp"

namespace nearmiss {

struct RandomPairs {
  std::uint64_t queries = 0;
  std::uint64_t boxes_meet = 0;   ///< pairs whose swept boxes meet
  std::uint64_t not_culled = 0;   ///< pairs that no plane separates
  std::uint64_t vertex_edge = 0;  ///< vertex-edge tests of pairs that no earlier test decides, including
                                  ///< the tests that §5's culling would omit
  std::uint64_t candidates = 0;   ///< all times in [0, 1] in the sets T of these tests (Algorithm 2)
  double bounds = 0;              ///< sum over the queries of B / (longest edge at t = 0)

  [[nodiscard]] double part(std::uint64_t some) const {
    return static_cast<double>(some) / static_cast<double>(queries);
  }
};

/// Counts how many of the first `queries` queries of this kind in the family `uniform` reach each stage of
/// the algorithms. All velocities of the queries are multiplied by `speed`. Vertices start in a unit cube,
/// and their velocity along each axis is from -speed to speed. Throws Stopped when `stop` is due.
RandomPairs count_random_pairs(Kind kind, double speed, std::uint64_t queries, std::uint64_t seed,
                               const Stop& stop);

}  // namespace nearmiss
