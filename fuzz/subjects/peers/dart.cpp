// DART's CCD of deformables, dart/collision/native/narrow_phase/PrimitiveCcd.cpp (dartsim/dart, bb9413c7,
// BSD-2-Clause): additive conservative advancement.
//
// It is asked as continuous_collision_step.cpp in its folder deformable_contact asks it, with a tolerance of 1e-6
// and 64 iterations. If these run out, DART treats the answer "indeterminate" as unsafe, and so does the
// answer "cannot tell" here. The time is a lower bound, which DART takes as the step. The separation is its
// minSeparation.
//
// Contract: none. Primitives that touch at the start collide at time 0.
//
// Options tolerance=1e-6, iterations=64.
//
//   tools/subject fuzz/subjects/peers/dart.cpp -- -I$DART -I$DART_BUILD -I/usr/include/eigen3 -L$DART_BUILD/lib
//     -ldart-collision-native
#include <dart/collision/native/narrow_phase/PrimitiveCcd.hpp>

#include "fuzz/subjects/peers/adapter.hpp"

namespace nearmiss::peers {
namespace {

namespace native = dart::collision::native;

struct Settings {
  double tolerance = 1e-6, iterations = 64;
};

constexpr std::array<Option<Settings>, 2> options{
    {{"tolerance", &Settings::tolerance, 0, 1e300}, {"iterations", &Settings::iterations, 1, 1e9}}};

Answer decide(const void* state, int kind, const Question& q) {
  const auto& settings = *static_cast<const Settings*>(state);
  native::CcdOption option;
  option.minSeparation = q.separation;
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
  nearmiss_subject subject = detector<decide>(
      "dart", "bb9413c7",
      "DART's additive CCD of deformables; options tolerance=1e-6, iterations=64 (unknown if they "
      "run out)");
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
