// ARCSim's CCD (Narain, Samii and O'Brien, "Adaptive anisotropic remeshing for cloth simulation", 2012, and
// later versions), collision_test() in src/collision.cpp. It solves the cubic numerically, and accepts a root
// at which the primitives are closer than 1e-6. This adapter passes each vertex as a node that has its
// positions at the start and at the end of the step, as ARCSim's find_face_impacts() does.
// Source: github.com/zhou13/arcsim, 28960d2. Licence: research, no fee.
// Question: contact; the time of impact is an estimate.
// Contract: the primitives are apart at t = 0. ARCSim starts each step from positions without collisions, and
// collision_test() leaves out pairs that are nearly coplanar at t = 0 ("initially coplanar").
// $ARCSIM is the repository. This adapter includes ARCSim's source file, because only that file has the type
// Impact. The linker drops most of that file's code:
//
//   tools/subject --pkg-config eigen3 fuzz/subjects/peers/arcsim.cpp -- -fopenmp -ffunction-sections
//       -fdata-sections -Wl,--gc-sections -fvisibility=hidden -I$ARCSIM/src
//       -I$ARCSIM/dependencies/jsoncpp/include $ARCSIM/src/{geometry,util,mesh}.cpp
#include <collision.cpp>
// ARCSim's headers define a macro of this name.
#undef static_assert

#include "ccd/nearmiss_functions.hpp"

namespace {

using nearmiss::plugin::Answer;
using nearmiss::plugin::Question;

Answer decide(const Question& q) {
  std::array<Node, 4> nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes[i].x0 = q.start(i);
    nodes[i].x = q.end(i);
  }
  Impact impact;
  const bool collides = collision_test(q.kind == NEARMISS_VERTEX_TRIANGLE ? Impact::VF : Impact::EE,
                                       &nodes[0], &nodes[1], &nodes[2], &nodes[3], impact);
  return Answer::of(collides, impact.t);
}

}  // namespace

NEARMISS_SUBJECT(detector("arcsim", "28960d2", "ARCSim's CCD, a numerical solver for cubics")
                     .vertex_triangle(decide)
                     .edge_edge(decide)
                     .set(&nearmiss_subject::time_sort, NEARMISS_TIME_ESTIMATE)
                     .set(&nearmiss_contract::apart_at_start, 1))
