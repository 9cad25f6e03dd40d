// ARCSim's CCD, collision_test() in src/collision.cpp (Narain, Samii and O'Brien, "Adaptive anisotropic
// remeshing for cloth simulation", 2012, and later versions; zhou13/arcsim, 28960d2, for research without
// fee).
//
// It gets nodes, which have a position and the position before, as from find_face_impacts(). It solves the
// cubic numerically, accepts a root at which the primitives are closer than 1e-6, and estimates the time.
//
// Contract: the primitives do not touch at the start. ARCSim starts each step from positions without
// collisions, and collision_test() leaves out pairs that are nearly coplanar then ("initially coplanar").
//
// Impact is a type of the source file, which is therefore included. Most of it is not needed:
//
//   tools/subject fuzz/subjects/peers/arcsim.cpp -- -std=c++17 -fopenmp -fvisibility=hidden
//     -ffunction-sections -fdata-sections -Wl,--gc-sections -I$ARCSIM/src -I$ARCSIM/dependencies/include
//     -I/usr/include/eigen3 $ARCSIM/src/geometry.cpp $ARCSIM/src/util.cpp $ARCSIM/src/mesh.cpp
#include <collision.cpp>

#include "fuzz/subjects/peers/adapter.hpp"

namespace nearmiss::peers {
namespace {

Answer decide(const void* /*state*/, int kind, const Question& q) {
  std::array<Node, 4> nodes;
  for (int i = 0; i < 4; ++i) {
    nodes[i].x0 = Vec3(q.start(i)[0], q.start(i)[1], q.start(i)[2]);
    nodes[i].x = Vec3(q.end(i)[0], q.end(i)[1], q.end(i)[2]);
  }
  Impact impact;
  const bool collides = collision_test(kind == NEARMISS_VERTEX_TRIANGLE ? Impact::VF : Impact::EE, &nodes[0],
                                       &nodes[1], &nodes[2], &nodes[3], impact);
  return Answer::of(collides, impact.t);
}

nearmiss_subject subject() {
  nearmiss_subject subject =
      detector<decide>("arcsim", "28960d2", "ARCSim's CCD, a numerical solver for cubics");
  subject.time_sort = NEARMISS_TIME_ESTIMATE;
  subject.contract.apart_at_start = 1;
  return subject;
}

}  // namespace
}  // namespace nearmiss::peers

__attribute__((visibility("default"))) const nearmiss_subject* nearmiss_get_subject(std::size_t index) {
  return nearmiss::peers::numbered<nearmiss::peers::subject>(index);
}
