// El Topo's CCD, common/ccd_wrapper.h, in one of its two versions. `eltopo`, the default, solves the cubic
// numerically (Brochu and Bridson, "Robust topological operations for dynamic explicit surfaces", 2009).
// `eltopo-root-parity` computes root parity (Brochu, Edwards and Bridson, 2012); for this version,
// common/ccd_defs.h defines USE_ROOT_PARITY_CCD. This adapter calls El Topo as eltopo3d/collisionpipeline.cpp
// does: it passes ascending indices of the vertices, and calls the functions that also find the place of
// contact. El Topo gives no time.
// Source: github.com/tysonbrochu/eltopo, 5579391. Licence: BSD.
// Question: contact; `eltopo-root-parity` answers whether the number of contacts is odd.
// Contract: the primitives are apart at t = 0, because El Topo starts from a surface without intersections,
// and prevents new intersections. The contract of `eltopo-root-parity` also requires that F, the volume of
// the four vertices, has at most one root, and that this root is simple.
// $ELTOPO is the repository, with its code compiled into libeltopo.a. The code for root parity rounds
// upwards, which the compiler must know (g++ needs -frounding-math). The command for `eltopo-root-parity`
// also has -o build/release/peers/eltopo-root-parity.so:
//
//   tools/subject fuzz/subjects/peers/eltopo.cpp -- -I$ELTOPO/common $ELTOPO/libeltopo.a
#include <ccd_defs.h>
#include <ccd_wrapper.h>

#include <cstdlib>

#include "ccd/nearmiss_functions.hpp"

namespace {

using nearmiss::plugin::Answer;
using nearmiss::plugin::Question;

#ifdef USE_ROOT_PARITY_CCD
constexpr bool is_root_parity = true;
#else
constexpr bool is_root_parity = false;
#endif

Answer decide(const Question& q) {
  // The code uses random rays, but an answer must depend only on the query.
  if (is_root_parity) std::srand(1);
  double a = 0, b = 0, c = 0, normal_displacement = 0;
  Vec3d normal(0.0, 0.0, 0.0);
  const auto test = [&](auto ask, auto&... weights) {
    return ask(q.start(0), q.end(0), 0, q.start(1), q.end(1), 1, q.start(2), q.end(2), 2, q.start(3),
               q.end(3), 3, weights..., normal, normal_displacement);
  };
  return Answer::of(q.kind == NEARMISS_VERTEX_TRIANGLE
                        ? test(NEARMISS_CALL(point_triangle_collision), a, b, c)
                        : test(NEARMISS_CALL(segment_segment_collision), a, b));
}

}  // namespace

NEARMISS_SUBJECT(detector(is_root_parity ? "eltopo-root-parity" : "eltopo", "5579391",
                          is_root_parity ? "El Topo's CCD, in its version with root parity"
                                         : "El Topo's CCD, with its default, a numerical solver for cubics")
                     .vertex_triangle(decide)
                     .edge_edge(decide)
                     .set(&nearmiss_contract::apart_at_start, 1)
                     .set(&nearmiss_contract::one_root, is_root_parity ? 1 : 0))
