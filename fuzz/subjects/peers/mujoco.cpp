// MuJoCo's conservative advancement of deformables, mjc_advance() in
// src/engine/engine_collision_continuous.c (google-deepmind/mujoco, a7255075b, Apache-2.0).
//
// It gets one pair of a flex vertex and a flex triangle, or of two flex edges, whose vertices are all free,
// as in its own test. It answers how far the step may go: alpha = 1, the whole step, or less, so far that
// no gap shrinks by more than 80 %. Its promise is that the advanced configuration has no intersection.
// Therefore alpha = 1 counts as "no collision", and alpha < 1 as a collision not before alpha. A false
// positive says only that the gap shrinks by 80 %.
//
// Contract: the primitives do not touch at the start. mjc_advance() leaves out pairs whose gap is 0 ("the
// contact solver owns it"); its header promises a positive gap at rest.
//
// Option same-flex=1: both primitives belong to one flex, and their mean motion does not count.
//
//   tools/subject fuzz/subjects/peers/mujoco.cpp -- -I$MUJOCO/include -I$MUJOCO/src
//     -L$MUJOCO_BUILD/lib -lmujoco
#include <engine/engine_collision_continuous.h>

#include "fuzz/subjects/peers/adapter.hpp"

namespace nearmiss::peers {
namespace {

struct Settings {
  double same_flex = 0;
};

constexpr std::array<Option<Settings>, 1> options{{{"same-flex", &Settings::same_flex, 0, 1}}};

Answer decide(const void* state, int kind, const Question& q) {
  const bool is_vertex_triangle = kind == NEARMISS_VERTEX_TRIANGLE;
  const bool is_one_flex = static_cast<const Settings*>(state)->same_flex != 0;
  const mjcFlexPair pair{is_vertex_triangle ? mjcFLEX_VERT_TRI : mjcFLEX_EDGE_EDGE, {0, 1, 2, 3}, -1};
  const int other = is_one_flex ? 0 : 1;
  const std::array<int, 4> flex{0, is_vertex_triangle ? other : 0, other, other};
  const std::array<int, 4> free_vertices{0, 1, 2, 3};
  const std::array<mjtNum, 4> radii{};  // flexes are compared at their middle surfaces
  std::array<mjtNum, 12> motion;
  for (std::size_t i = 0; i < motion.size(); ++i) motion[i] = q.end(0)[i] - q.start(0)[i];

  std::array<mjtNum, 3> normal;
  std::array<mjtNum, 4> weights;
  std::array<int, 4> vertices;
  int count = 0;
  const mjtNum gap = mjc_pairGap(&pair, nullptr, nullptr, q.x, nullptr, nullptr, radii.data(), normal.data(),
                                 vertices.data(), weights.data(), &count, 1e30);
  const mjtNum alpha = mjc_advance(nullptr, nullptr, q.x, motion.data(), nullptr, nullptr, radii.data(), 4,
                                   free_vertices.data(), &pair, 1, &gap, flex.data(), nullptr, nullptr);
  return Answer::of(!(alpha >= 1), alpha);
}

nearmiss_subject subject() {
  nearmiss_subject subject = detector<decide>(
      "mujoco", "a7255075b",
      "MuJoCo's mjc_advance: whether the step is cut, at 80 % of the gap at the latest; option same-flex=0");
  subject.time_sort = NEARMISS_TIME_LOWER_BOUND;
  subject.contract.apart_at_start = 1;
  take_options<Settings, options>(subject);
  return subject;
}

}  // namespace
}  // namespace nearmiss::peers

const nearmiss_subject* nearmiss_get_subject(std::size_t index) {
  return nearmiss::peers::numbered<nearmiss::peers::subject>(index);
}
