// The additive CCD of ZOZO's contact solver, src/cpp/contact/accd.hpp (st-tech/ppf-contact-solver, f23b356,
// Apache-2.0). It is CUDA code in single precision, and is compiled for the host here. On a GPU, the
// compiler fuses multiplications with additions, so that the last bits may differ.
//
// It is asked as contact.cu asks it. The time step is extended to t = 1.25 (line-search-max-t): a time
// below 1.25 is a collision, which cuts the step to 0.8 of that time (line_search() divides by 1.25). This
// is the time passed on, as a lower bound, and contact between t = 1 and t = 1.25 is a collision, too: such
// a false positive is by design. So is one farther from contact: pairs are parked at a hundredth of the
// contact gap. The separation is its contact offset. It also decides two vertices, and a vertex and an
// edge.
//
// Contract: at the start, the primitives are farther apart than the separation, and than 5e-6. Otherwise
// the solver stops with the error OverlappingStart, and accd.hpp argues that it keeps a clearance of half
// the distance at which it parks, 5e-6 with the default gap. No edge or path is longer than 10, because the
// argument's margin for rounding is given for "a scene of radius 10". (A separation would need the 5e-6 on
// top, which a contract cannot say.)
//
// Options gap=1e-3 (contact-gap), eps=1e-7 (ccd-eps), end=1.25 (line-search-max-t): its own defaults.
//
//   tools/subject fuzz/subjects/peers/ppf.cpp -- -I$PPF/crates/ppf-cts-solver/src/cpp
//     -I/usr/local/cuda/include
#include <algorithm>
#include <cmath>

// What the compiler for CUDA knows by itself.
#ifndef __CUDACC__
#define __device__  // NOLINT(bugprone-reserved-identifier)
#define __host__    // NOLINT(bugprone-reserved-identifier)
#define __global__  // NOLINT(bugprone-reserved-identifier)
using std::isfinite;
using std::max;
using std::min;
#endif

#include <contact/accd.hpp>

#include "fuzz/subjects/peers/adapter.hpp"

namespace accd {  // what contact.cu defines: notes of the first pair that overlaps at the start
unsigned g_ccd_overlap = 0, g_ccd_overlap_v0 = 0, g_ccd_overlap_v1 = 0, g_ccd_overlap_kind = 0;
float g_ccd_overlap_d2 = 0, g_ccd_overlap_offset = 0;
}  // namespace accd

namespace nearmiss::peers {
namespace {

struct Settings {
  double gap = 1e-3, eps = 1e-7, end = 1.25;
};

constexpr std::array<Option<Settings>, 3> options{
    {{"gap", &Settings::gap, 0, 1e30}, {"eps", &Settings::eps, 0, 1e30}, {"end", &Settings::end, 1, 1e30}}};

Answer ask(const Settings& settings, int kind, const double* x, double separation) {
  const auto v = [&](int vertex) {
    const double* const at = x + 3 * vertex;
    return Vec3f(static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2]));
  };
  const auto offset = static_cast<float>(separation), gap = static_cast<float>(settings.gap);
  ParamSet param{};
  param.line_search_max_t = static_cast<float>(settings.end);
  param.ccd_eps = static_cast<float>(settings.eps);
  float time = 0;
  switch (kind) {
    case NEARMISS_VERTEX_VERTEX:
      time = accd::point_point_ccd(v(0), v(2), v(1), v(3), offset, gap, param);
      break;
    case NEARMISS_VERTEX_EDGE:
      time = accd::point_edge_ccd(v(0), v(3), v(1), v(2), v(4), v(5), offset, gap, param);
      break;
    case NEARMISS_VERTEX_TRIANGLE:
      time = accd::point_triangle_ccd(v(0), v(4), v(1), v(2), v(3), v(5), v(6), v(7), offset, gap, param);
      break;
    default:
      time = accd::edge_edge_ccd(v(0), v(1), v(2), v(3), v(4), v(5), v(6), v(7), offset, gap, param);
  }
  return Answer::of(time < param.line_search_max_t, time / param.line_search_max_t);
}

void decide(void* state, int kind, std::size_t n, const double* x, const double* h, int* answer,
            double* toi) {
  const std::size_t row = kind == NEARMISS_VERTEX_VERTEX ? 12 : kind == NEARMISS_VERTEX_EDGE ? 18 : 24;
  for (std::size_t i = 0; i < n; ++i) {
    const Answer said = ask(*static_cast<const Settings*>(state), kind, x + row * i, h[i]);
    answer[i] = said.value;
    toi[i] = said.time;
  }
}

nearmiss_subject subject() {
  nearmiss_subject subject{};
  subject.interface_version = NEARMISS_INTERFACE;
  subject.name = "ppf";
  subject.version = "f23b356";
  subject.about =
      "additive CCD of ppf-contact-solver in float, compiled for the host; options gap=1e-3, eps=1e-7, "
      "end=1.25";
  subject.kinds =
      NEARMISS_VERTEX_TRIANGLE + NEARMISS_EDGE_EDGE + NEARMISS_VERTEX_VERTEX + NEARMISS_VERTEX_EDGE;
  subject.bits = 24;
  subject.time_sort = NEARMISS_TIME_LOWER_BOUND;
  subject.takes_separation = 1;
  subject.contract.apart_at_start = 1;
  subject.contract.apart_by = 5e-6;
  subject.contract.longest = 10;
  subject.decide = decide;
  take_options<Settings, options>(subject);
  return subject;
}

}  // namespace
}  // namespace nearmiss::peers

const nearmiss_subject* nearmiss_get_subject(std::size_t index) {
  return nearmiss::peers::numbered<nearmiss::peers::subject>(index);
}
