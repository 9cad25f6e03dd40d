// Lists of candidates, and the same lists by brute force.
#pragma once

#include <vector>

#include "fuzz/scenes/candidates.hpp"
#include "oracle/filter/box.hpp"

namespace nearmiss {

/// The candidates of a mesh, in the order in which a new finder passes them on.
inline std::vector<Candidate> found_candidates(const MovingMesh& mesh) {
  std::vector<Candidate> found;
  find_candidates(mesh, [&](const Candidate& candidate) { found.push_back(candidate); });
  return found;
}

/// The same list: all pairs, row by row, whose boxes meet.
inline std::vector<Candidate> candidates_by_brute_force(const MovingMesh& mesh) {
  std::vector<Candidate> found;
  for (const Kind kind : kinds)
    for (std::size_t row = 0; row < pair_rows(mesh, kind); ++row)
      for_pairs_of_row(
          mesh, kind, row,
          [&](const Candidate& candidate) {
            if (boxes_meet(make_query(mesh, candidate))) found.push_back(candidate);
          },
          never_over);
  return found;
}

}  // namespace nearmiss
