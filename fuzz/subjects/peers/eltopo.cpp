// El Topo's CCD, common/ccd_wrapper.h (tysonbrochu/eltopo, 5579391, BSD-2-Clause), in one of its two
// versions: `eltopo` solves the cubic numerically, which is its default; `eltopo-root-parity` uses the
// authors' root parity (with USE_ROOT_PARITY_CCD in common/ccd_defs.h).
//
// It is asked as eltopo3d/collisionpipeline.cpp asks it, with indices in ascending order and the function
// that also finds the place of contact. No time leaves it.
//
// Contract: the primitives do not touch at the start, because El Topo starts from a surface without
// intersections and keeps it so. Root parity says whether the number of contacts is odd, and so is judged
// on queries whose F has one root at most. Its rays are random; every query starts from the same seed,
// because an answer must depend only on the query.
//
// Its headers are not C++20:
//
//   tools/subject fuzz/subjects/peers/eltopo.cpp -- -std=c++17 -I$ELTOPO/common -L$ELTOPO_BUILD -leltopo
#include <ccd_defs.h>
#include <ccd_wrapper.h>

#include <cstdlib>

#include "fuzz/subjects/peers/adapter.hpp"

namespace nearmiss::peers {
namespace {

Answer decide(const void* /*state*/, int kind, const Question& q) {
#ifdef USE_ROOT_PARITY_CCD
  std::srand(1);
#endif
  const auto start = [&](int vertex) { return Vec3d(q.start(vertex)); };
  const auto end = [&](int vertex) { return Vec3d(q.end(vertex)); };
  double a = 0, b = 0, c = 0, normal_displacement = 0;
  Vec3d normal(0.0, 0.0, 0.0);
  return Answer::of(
      kind == NEARMISS_VERTEX_TRIANGLE
          ? point_triangle_collision(start(0), end(0), 0, start(1), end(1), 1, start(2), end(2), 2, start(3),
                                     end(3), 3, a, b, c, normal, normal_displacement)
          : segment_segment_collision(start(0), end(0), 0, start(1), end(1), 1, start(2), end(2), 2, start(3),
                                      end(3), 3, a, b, normal, normal_displacement));
}

nearmiss_subject subject() {
#ifdef USE_ROOT_PARITY_CCD
  nearmiss_subject subject =
      detector<decide>("eltopo-root-parity", "5579391", "El Topo's CCD, in its version with root parity");
  subject.contract.one_root = 1;
#else
  nearmiss_subject subject =
      detector<decide>("eltopo", "5579391", "El Topo's CCD, with its default, a numerical solver for cubics");
#endif
  subject.contract.apart_at_start = 1;
  return subject;
}

}  // namespace
}  // namespace nearmiss::peers

const nearmiss_subject* nearmiss_get_subject(std::size_t index) {
  return nearmiss::peers::numbered<nearmiss::peers::subject>(index);
}
