// The minimum separation root finder (Harmon, Panozzo, Sorkine and Zorin, "Interference-aware geometric
// modeling", 2011, in the implementation of the Tight-Inclusion authors). It looks for the times at which the
// distance is equal to a separation h, and accepts the times at which the squared distance is at most h² + h
// / 10. With h = 0, the tolerance h / 10 leaves no room for rounding errors, so the root finder finds hardly
// any collision. Therefore, this adapter always passes a separation h > 0. The root finder does not notice if
// the distance is already below h at t = 0.
// Source: github.com/Continuous-Collision-Detection/Minimum-Separation-Root-Finder, src, 1aeb9ac0. Licence:
// MIT.
// Question: a separation. If the query asks for contact, the separation is 1e-8. The time of impact is an
// estimate.
// Contract: at t = 0, the primitives are more than 1e-8 apart.
// $MSRF is the repository, with its code compiled into libmsrf.a:
//
//   tools/subject --pkg-config eigen3 fuzz/subjects/peers/msrf.cpp -- -I$MSRF/src $MSRF/libmsrf.a
#include <minimum_separation_root_finder.hpp>

#include "ccd/nearmiss_functions.hpp"

namespace {

using nearmiss::plugin::Answer;
using nearmiss::plugin::Question;

/// The separation that the root finder gets if the query asks for contact. The authors of this implementation
/// use this separation in their benchmark when they ask for collisions at distance 0 (DEFAULT_MIN_DISTANCE of
/// CCD-Wrapper, src/ccd.hpp).
constexpr double contact = 1e-8;

Answer decide(const Question& q) {
  const double separation = q.separation > 0 ? q.separation : contact;
  double toi = 0;
  const auto test = q.kind == NEARMISS_VERTEX_TRIANGLE ? msccd::root_finder::vertexFaceMSCCD
                                                       : msccd::root_finder::edgeEdgeMSCCD;
  const bool collides = with_vertices(q, [&](const auto&... v) { return test(v..., separation, toi); });
  return Answer::of(collides, toi);
}

}  // namespace

NEARMISS_SUBJECT(
    detector("msrf", "1aeb9ac0",
             "minimum separation root finder; when asked for contact, answers for a separation of 1e-8")
        .vertex_triangle(decide)
        .edge_edge(decide)
        .set(&nearmiss_subject::time_sort, NEARMISS_TIME_ESTIMATE)
        .set(&nearmiss_subject::takes_separation, 1)
        .set(&nearmiss_contract::apart_at_start, 1)
        .set(&nearmiss_contract::apart_by, contact))
