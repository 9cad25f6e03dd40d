// The code that Wang published with his 2014 paper "Defending continuous collision detection against errors".
// It is called through a wrapper, which is part of the source tree that the code is taken from, and computes
// each pair's own bound B.
//
// Contact at t = 0 is left to the step before: Vertex_Vertex_CCD ("Now test the case when t=1") and case 1 of
// Vertex_Edge_CCD test the end of the step, and nothing tests its beginning. That is why B "must stay the
// same over the whole animation process".
#include <safeCCDWrapper.h>

#include "fuzz/subjects/peers/adapter.hpp"

namespace nearmiss::peers {
namespace {

/// Makes the wrapper's function for B accessible.
struct Wrapper : SafeCCDWrapper {
  using SafeCCDWrapper::computeB;
};

Answer decide(const void* /*state*/, int kind, const Question& q) {
  double t = 0, r = 0, s = 0;  // the code uses the weights r and s even if nobody needs them
  const auto test =
      kind == NEARMISS_VERTEX_TRIANGLE ? SafeCCDWrapper::VertexTriangleCCD : SafeCCDWrapper::EdgeEdgeCCD;
  const bool collides =
      test(q.start(0), q.end(0), q.start(1), q.end(1), q.start(2), q.end(2), q.start(3), q.end(3), t, &r, &s);
  return Answer::of(collides, t);
}

/// 41 B ε^¼ with ε^¼ = 2^-13: the paper's claim, and half of `gap` in the code. The code says that `gap` is
/// twice the largest distance of a false positive.
double distance_bound(void* /*state*/, int /*kind*/, const double* x) {
  const Question q{x, 0};
  return 41 * 0x1p-13 *
         Wrapper::computeB(q.start(0), q.end(0), q.start(1), q.end(1), q.start(2), q.end(2), q.start(3),
                           q.end(3));
}

nearmiss_subject subject() {
  nearmiss_subject subject =
      detector<decide>("safeccd", "1.0", "the 2014 paper's own code, SAFE_CCD, with each pair's own bound B");
  subject.time_sort = NEARMISS_TIME_ESTIMATE;
  subject.contract.apart_at_start = 1;
  // Its tests multiply up to six lengths, and nothing scales them: beyond 1e±50 the products overflow or
  // vanish. If all coordinates are multiples of about 1e-50, B is at least 1e-50, too, unless all points of
  // the pair coincide at all times.
  subject.contract.longest = 1e50;
  subject.contract.grid = 0x1p-166;
  subject.distance_bound = distance_bound;
  return subject;
}

}  // namespace
}  // namespace nearmiss::peers

const nearmiss_subject* nearmiss_get_subject(std::size_t index) {
  return nearmiss::peers::numbered<nearmiss::peers::subject>(index);
}
