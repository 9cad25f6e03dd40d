// The additive CCD of ZOZO's contact solver, src/cpp/contact/accd.hpp. It is CUDA code in single precision,
// here compiled for the host. On a GPU, the compiler fuses multiplications with additions, which may change
// the last bits. This adapter calls the code as contact.cu does, with the time step extended to t = 1.25
// (line-search-max-t). A time below 1.25 is a collision. The solver then cuts the step to 0.8 of that time
// (line_search() divides by 1.25); the adapter passes on this shorter time. By design, two further cases are
// collisions: contact between t = 1 and t = 1.25, and an approach to a hundredth of the contact gap, because
// the solver stops pairs at this distance.
// Source: github.com/st-tech/ppf-contact-solver, f23b356. Licence: Apache 2.0.
// Question: contact, or a separation, which the code calls contact offset. The time of impact is a lower
// bound. The options have the solver's defaults: gap=1e-3 (contact-gap), eps=1e-7 (ccd-eps), end=1.25
// (line-search-max-t).
// Contract: the primitives are farther apart at t = 0 than the separation, and farther than 5e-6. From a
// closer start, the solver stops with the error OverlappingStart. According to accd.hpp, the solver never
// leaves a pair so close: it stops pairs at a distance of 1e-5, and they keep at least half of this distance.
// No edge, and no path of a vertex in the step, is longer than 10, because the margin for rounding is given
// for "a scene of radius 10". (With a separation, the primitives would have to be farther apart than the
// separation plus 5e-6, which a contract cannot say.)
// $PPF is the repository, whose header contains the whole code, and $CUDA is the folder of CUDA's headers. No
// GPU is needed:
//
//   tools/subject fuzz/subjects/peers/ppf.cpp -- -I$PPF/crates/ppf-cts-solver/src/cpp -I$CUDA/include
#include <algorithm>
#include <cmath>

// The compiler for CUDA defines these names.
#define __device__  // NOLINT(bugprone-reserved-identifier)
#define __host__    // NOLINT(bugprone-reserved-identifier)
#define __global__  // NOLINT(bugprone-reserved-identifier)
using std::isfinite;
using std::max;
using std::min;

#include <contact/accd.hpp>

#include "ccd/nearmiss_functions.hpp"

namespace accd {  // contact.cu defines these variables, which describe the first pair that overlaps at t = 0
unsigned g_ccd_overlap = 0, g_ccd_overlap_v0 = 0, g_ccd_overlap_v1 = 0, g_ccd_overlap_kind = 0;
float g_ccd_overlap_d2 = 0, g_ccd_overlap_offset = 0;
}  // namespace accd

namespace {

using nearmiss::plugin::Answer;
using nearmiss::plugin::Question;

struct Settings {
  double gap = 1e-3, eps = 1e-7, end = 1.25;
};

constexpr std::array<nearmiss::Option<Settings>, 3> settings{
    {{"gap", &Settings::gap, 0, 1e30}, {"eps", &Settings::eps, 0, 1e30}, {"end", &Settings::end, 1, 1e30}}};

Answer decide(const Settings& set, const Question& q) {
  const auto offset = static_cast<float>(q.separation), gap = static_cast<float>(set.gap);
  ParamSet param{};
  param.line_search_max_t = static_cast<float>(set.end);
  param.ccd_eps = static_cast<float>(set.eps);
  const auto test = [&](const auto& ask, auto... v) { return ask(Vec3f(v)..., offset, gap, param); };
  float time = 0;
  // The functions for a vertex take its start and its end, then the starts of the other primitive's vertices,
  // then the ends of those vertices.
  switch (q.kind) {
    case NEARMISS_VERTEX_VERTEX:
      time = test(accd::point_point_ccd, q.start(0), q.end(0), q.start(1), q.end(1));
      break;
    case NEARMISS_VERTEX_EDGE:
      time = test(accd::point_edge_ccd, q.start(0), q.end(0), q.start(1), q.start(2), q.end(1), q.end(2));
      break;
    case NEARMISS_VERTEX_TRIANGLE:
      time = test(accd::point_triangle_ccd, q.start(0), q.end(0), q.start(1), q.start(2), q.start(3),
                  q.end(1), q.end(2), q.end(3));
      break;
    default:
      time = with_vertices(q, [&](const auto&... v) { return test(accd::edge_edge_ccd, v...); });
  }
  return Answer::of(time < param.line_search_max_t, time / param.line_search_max_t);
}

}  // namespace

NEARMISS_SUBJECT(
    detector("ppf", "f23b356",
             "additive CCD of ppf-contact-solver in float, compiled for the host; options gap=1e-3, "
             "eps=1e-7, end=1.25")
        .options<settings>()
        .vertex_triangle(decide)
        .edge_edge(decide)
        .vertex_vertex(decide)
        .vertex_edge(decide)
        .set(&nearmiss_subject::bits, 24)
        .set(&nearmiss_subject::time_sort, NEARMISS_TIME_LOWER_BOUND)
        .set(&nearmiss_subject::takes_separation, 1)
        .set(&nearmiss_contract::apart_at_start, 1)
        .set(&nearmiss_contract::apart_by, 5e-6)
        .set(&nearmiss_contract::longest, 10))
