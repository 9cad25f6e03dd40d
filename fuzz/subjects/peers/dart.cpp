// DART's CCD of deformables, dart/collision/native/narrow_phase/PrimitiveCcd.cpp (dartsim/dart, bb9413c7,
// BSD-2-Clause): additive conservative advancement.
//
// It is asked as its deformable solver asks it (makeSurfaceContactCcdOptions()), with a separation of 1e-4,
// a tolerance of 1e-6 and 128 iterations. If these run out, DART treats the answer "indeterminate" as
// unsafe, and so does the answer "cannot tell" here. The time is a lower bound, which DART takes as the
// step. A false positive within 1e-4 is by design.
//
// Contract: none. Primitives within the separation at the start collide at time 0.
//
// Options separation=1e-4 (what stands for contact), tolerance=1e-6, iterations=128.
//
//   tools/subject fuzz/subjects/peers/dart.cpp -- -I$DART -I$DART_BUILD -I/usr/include/eigen3
//     -L$DART_BUILD/lib -ldart-collision-native
#include <dart/collision/native/narrow_phase/PrimitiveCcd.hpp>

#include "fuzz/subjects/peers/adapter.hpp"

namespace nearmiss::peers {
namespace {

namespace native = dart::collision::native;

struct Settings {
  double separation = 1e-4, tolerance = 1e-6, iterations = 128;
};

constexpr std::array<Option<Settings>, 3> options{{{"separation", &Settings::separation, 0, 1e300},
                                                   {"tolerance", &Settings::tolerance, 0, 1e300},
                                                   {"iterations", &Settings::iterations, 1, 1e9}}};

Answer decide(const void* state, int kind, const Question& q) {
  const auto& settings = *static_cast<const Settings*>(state);
  native::CcdOption option;
  option.minSeparation = q.separation > 0 ? q.separation : settings.separation;
  option.tolerance = settings.tolerance;
  option.maxIterations = static_cast<int>(settings.iterations);
  const auto start = [&](int vertex) {
    return Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(q.start(vertex)));
  };
  const auto end = [&](int vertex) {
    return Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(q.end(vertex)));
  };
  native::CcdPrimitiveResult result;
  const auto test = kind == NEARMISS_VERTEX_TRIANGLE ? native::pointTriangleCcd : native::edgeEdgeCcd;
  const bool collides =
      test(start(0), end(0), start(1), end(1), start(2), end(2), start(3), end(3), option, result);
  if (result.status == native::CcdPrimitiveStatus::Indeterminate) return {NEARMISS_UNKNOWN, 0};
  return Answer::of(collides, result.timeOfImpact);
}

nearmiss_subject subject() {
  nearmiss_subject subject =
      detector<decide>("dart", "bb9413c7",
                       "DART's additive CCD of deformables; options separation=1e-4 (stands for contact), "
                       "tolerance=1e-6, iterations=128 (unknown if they run out)");
  subject.time_sort = NEARMISS_TIME_LOWER_BOUND;
  subject.takes_separation = 1;
  take_options<Settings, options>(subject);
  return subject;
}

}  // namespace
}  // namespace nearmiss::peers

const nearmiss_subject* nearmiss_get_subject(std::size_t index) {
  return nearmiss::peers::numbered<nearmiss::peers::subject>(index);
}
