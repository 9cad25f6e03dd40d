// DART's additive CCD for deformables, dart/collision/native/narrow_phase/PrimitiveCcd.cpp. This adapter
// calls it as DART's deformable solver does (makeSurfaceContactCcdOptions()), with a separation of 1e-4, a
// tolerance of 1e-6 and 128 iterations. If the iterations run out, the answer is "indeterminate", which DART
// treats as unsafe; here, the answer becomes "cannot tell".
// Source: github.com/dartsim/dart, bb9413c7. Licence: BSD.
// Question: a separation. If the query asks for contact, the separation is 1e-4 (an option). The time of
// impact is a lower bound.
// Contract: none. Primitives within the separation at t = 0 collide at time 0.
// $DART is the repository, built in $DART/build:
//
//   tools/subject --pkg-config eigen3 fuzz/subjects/peers/dart.cpp -- -std=c++20 -I$DART -I$DART/build
//       -L$DART/build/lib -ldart-collision-native
#include <dart/collision/native/narrow_phase/PrimitiveCcd.hpp>

#include "ccd/nearmiss_functions.hpp"

namespace {

using nearmiss::plugin::Answer;
using nearmiss::plugin::Question;
namespace native = dart::collision::native;

struct Settings {
  double separation = 1e-4, tolerance = 1e-6, iterations = 128;
};

constexpr std::array<nearmiss::Option<Settings>, 3> settings{{{"separation", &Settings::separation, 0, 1e300},
                                                              {"tolerance", &Settings::tolerance, 0, 1e300},
                                                              {"iterations", &Settings::iterations, 1, 1e9}}};

Answer decide(const Settings& set, const Question& q) {
  native::CcdOption option;
  option.minSeparation = q.separation > 0 ? q.separation : set.separation;
  option.tolerance = set.tolerance;
  option.maxIterations = static_cast<int>(set.iterations);
  native::CcdPrimitiveResult result;
  const auto test = q.kind == NEARMISS_VERTEX_TRIANGLE ? native::pointTriangleCcd : native::edgeEdgeCcd;
  const bool collides = test(q.start(0), q.end(0), q.start(1), q.end(1), q.start(2), q.end(2), q.start(3),
                             q.end(3), option, result);
  if (result.status == native::CcdPrimitiveStatus::Indeterminate) return {NEARMISS_UNKNOWN, 0};
  return Answer::of(collides, result.timeOfImpact);
}

}  // namespace

NEARMISS_SUBJECT(detector("dart", "bb9413c7",
                          "DART's additive CCD of deformables; options separation=1e-4 (stands for contact), "
                          "tolerance=1e-6, iterations=128 (unknown if they run out)")
                     .options<settings>()
                     .vertex_triangle(decide)
                     .edge_edge(decide)
                     .set(&nearmiss_subject::time_sort, NEARMISS_TIME_LOWER_BOUND)
                     .set(&nearmiss_subject::takes_separation, 1))
