// The code that Wang published with his 2014 paper "Defending continuous collision detection against errors",
// called through the wrapper in libpgo. The wrapper computes B, the size of a pair, for each pair.
// Source: github.com/bohanwang/libpgo, third-party/CCD/SafeCCD, 88dfe845. Licence: BSD-like, in its header.
// Question: contact; the time of impact is an estimate.
// Contract: the primitives are apart at t = 0, and their lengths are neither too large nor too small (end of
// this file).
// $SAFECCD is the folder SafeCCD, with its code compiled into libsafeccd.a:
//
//   tools/subject fuzz/subjects/peers/safeccd.cpp -- -I$SAFECCD $SAFECCD/libsafeccd.a
//
// The code leaves contact at t = 0 to the step before: Vertex_Vertex_CCD ("Now test the case when t=1") and
// case 1 of Vertex_Edge_CCD test the end of the step, and nothing tests its beginning. This is why B "must
// stay the same over the whole animation process".
#include <safeCCDWrapper.h>

#include "ccd/nearmiss_functions.hpp"

namespace {

using nearmiss::plugin::Answer;
using nearmiss::plugin::Question;

/// Makes the wrapper's function for B accessible.
struct Wrapper : SafeCCDWrapper {
  using SafeCCDWrapper::computeB;
};

Answer decide(const Question& q) {
  double t = 0, r = 0, s = 0;  // we do not use the weights r and s, but the code writes them
  const auto test =
      q.kind == NEARMISS_VERTEX_TRIANGLE ? SafeCCDWrapper::VertexTriangleCCD : SafeCCDWrapper::EdgeEdgeCCD;
  const bool collides =
      test(q.start(0), q.end(0), q.start(1), q.end(1), q.start(2), q.end(2), q.start(3), q.end(3), t, &r, &s);
  return Answer::of(collides, t);
}

/// The bound that the paper claims: 41 B ε^¼, with ε^¼ = 2^-13. The code says the same: the largest distance
/// of a false positive is half of `gap`, and `gap` is twice this bound.
double distance_bound(void* /*state*/, int kind, const double* x) {
  const Question q{kind, x, 0};
  return 41 * 0x1p-13 *
         Wrapper::computeB(q.start(0), q.end(0), q.start(1), q.end(1), q.start(2), q.end(2), q.start(3),
                           q.end(3));
}

}  // namespace

// The code's tests multiply up to six unscaled lengths. These products overflow for lengths above 1e50, and
// vanish for lengths below 1e-50. The contract requires that all coordinates are multiples of about 1e-50, so
// B is at least 1e-50, unless all points of the pair coincide at all times.
NEARMISS_SUBJECT(detector("safeccd", "1.0",
                          "the 2014 paper's own code, SAFE_CCD, with each pair's own bound B")
                     .vertex_triangle(decide)
                     .edge_edge(decide)
                     .set(&nearmiss_subject::time_sort, NEARMISS_TIME_ESTIMATE)
                     .set(&nearmiss_subject::distance_bound, distance_bound)
                     .set(&nearmiss_contract::apart_at_start, 1)
                     .set(&nearmiss_contract::longest, 1e50)
                     .set(&nearmiss_contract::grid, 0x1p-166))
