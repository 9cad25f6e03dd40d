// MuJoCo's conservative advancement of deformables, mjc_advance() in
// src/engine/engine_collision_continuous.c. It answers with alpha, the part of the step that may be taken:
// the whole step, or a part in which no pair's gap shrinks by more than 80 %. It promises that the advanced
// configuration has no intersection. Therefore, alpha < 1 counts as a collision, and alpha is a lower bound
// of the time of impact. A false positive says only that a gap shrinks by more than 80 %. As in MuJoCo's own
// test, the adapter passes a single pair: a flex vertex and a flex triangle, or two flex edges. All vertices
// are free.
// Source: github.com/google-deepmind/mujoco, a7255075b. Licence: Apache 2.0.
// Question: contact; the time of impact is a lower bound. With same-flex=1, both primitives belong to one
// flex (a deformable), and their mean motion does not count.
// Contract: the primitives are apart at t = 0. mjc_advance() leaves out pairs whose gap is 0 ("the contact
// solver owns it"), and its header promises a positive gap at rest.
// $MUJOCO is the repository, with src/engine/engine_{collision_continuous,util_blas,util_errmem}.c compiled
// into libmujoco.a:
//
//   tools/subject fuzz/subjects/peers/mujoco.cpp -- -I$MUJOCO/include -I$MUJOCO/src $MUJOCO/libmujoco.a
#include <engine/engine_collision_continuous.h>

#include "ccd/nearmiss_functions.hpp"

namespace {

using nearmiss::plugin::Answer;
using nearmiss::plugin::Question;

struct Settings {
  double same_flex = 0;
};

constexpr std::array<nearmiss::Option<Settings>, 1> settings{{{"same-flex", &Settings::same_flex, 0, 1}}};

Answer decide(const Settings& set, const Question& q) {
  const bool is_vertex_triangle = q.kind == NEARMISS_VERTEX_TRIANGLE;
  const mjcFlexPair pair{is_vertex_triangle ? mjcFLEX_VERT_TRI : mjcFLEX_EDGE_EDGE, {0, 1, 2, 3}, -1};
  const int other = set.same_flex != 0 ? 0 : 1;
  const std::array<int, 4> flex{0, is_vertex_triangle ? other : 0, other, other};
  const std::array<int, 4> free_vertices{0, 1, 2, 3};
  // The radii are zero, because gaps are measured between middle surfaces.
  const std::array<mjtNum, 4> radii{};
  const std::array<mjtNum, 24> x = displaced(q);

  std::array<mjtNum, 3> normal;
  std::array<mjtNum, 4> weights;
  std::array<int, 4> vertices;
  int count = 0;
  const mjtNum gap = mjc_pairGap(&pair, nullptr, nullptr, x.data(), nullptr, nullptr, radii.data(),
                                 normal.data(), vertices.data(), weights.data(), &count, 1e30);
  const mjtNum alpha = mjc_advance(nullptr, nullptr, x.data(), x.data() + 12, nullptr, nullptr, radii.data(),
                                   4, free_vertices.data(), &pair, 1, &gap, flex.data(), nullptr, nullptr);
  return Answer::of(!(alpha >= 1), alpha);
}

/// The gap of the pair, which is the distance, since the radii are 0. mjc_advance() relies on this gap.
double gap(mjcFlexPairType type, const double* a, const double* b, const double* c, const double* d) {
  const mjcFlexPair pair{type, {0, 1, 2, 3}, -1};
  std::array<mjtNum, 12> x;
  for (int k = 0; k < 3; ++k) x[k] = a[k], x[3 + k] = b[k], x[6 + k] = c[k], x[9 + k] = d[k];
  const std::array<mjtNum, 4> radii{};
  std::array<mjtNum, 3> normal;
  std::array<mjtNum, 4> weights;
  std::array<int, 4> vertices;
  int count = 0;
  return mjc_pairGap(&pair, nullptr, nullptr, x.data(), nullptr, nullptr, radii.data(), normal.data(),
                     vertices.data(), weights.data(), &count, 1e30);
}

double vertex_triangle_gap(const Settings& /*set*/, const double* a, const double* b, const double* c,
                           const double* d) {
  return gap(mjcFLEX_VERT_TRI, a, b, c, d);
}

double edge_edge_gap(const Settings& /*set*/, const double* a, const double* b, const double* c,
                     const double* d) {
  return gap(mjcFLEX_EDGE_EDGE, a, b, c, d);
}

}  // namespace

NEARMISS_SUBJECT(
    detector("mujoco", "a7255075b",
             "MuJoCo's mjc_advance: whether the step is cut, at 80 % of the gap at the latest; option "
             "same-flex=0")
        .options<settings>()
        .vertex_triangle(decide)
        .edge_edge(decide)
        .vertex_triangle_distance(vertex_triangle_gap)
        .edge_edge_distance(edge_edge_gap)
        .set(&nearmiss_subject::time_sort, NEARMISS_TIME_LOWER_BOUND)
        .set(&nearmiss_contract::apart_at_start, 1))
