// The basic cubic CCD (Provot 1997; Bridson et al. 2002) without any tolerance: the baseline.
#pragma once

#include "ccd/wang/cubic.hpp"
#include "ccd/wang/plane_culling.hpp"
#include "ccd/wang/proximity.hpp"
#include "ccd/wang/verdict.hpp"

namespace nearmiss {

/// Solves F(t) = 0, where F is the coplanarity cubic, as well as the scalar allows, and applies the
/// barycentric test at each root. This CCD guarantees nothing: it misses a collision if rounding hides the
/// root, or if rounding moves a weight out of [0, 1]. `Wide` is the scalar in which normals and weights are
/// computed.
template <Kind kind, class T, bool plane_culling, class Wide = T>
Verdict basic(const Query& query) {
  if (plane_culling && separated_by_plane<kind>(query)) return Verdict::rejected(Rejection::planes);
  Pair<kind, T> pair;  // without a bound B, and so without normalisation
  form_vectors(query, pair);
  const auto roots = solve_cubic(coplanarity(pair), T(0));
  for (const T& t : roots)
    if (Configuration<kind, T, Wide>(pair, t).inside())
      return Verdict::accepted(Stage::proximity, static_cast<double>(t));
  return Verdict::rejected(roots.count == 0 ? Rejection::no_root : Rejection::tests);
}

}  // namespace nearmiss
