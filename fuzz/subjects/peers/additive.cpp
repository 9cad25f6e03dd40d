// Additive CCD (Li, Kaufman and Jiang, "Codimensional incremental potential contact", 2021) as implemented in
// ipc-toolkit. The authors of ipc-toolkit say that rounding errors can make this CCD miss collisions.
// Source: github.com/ipc-sim/ipc-toolkit, b40e9c07. Licence: MIT.
// Question: contact, or a separation; the time of impact is a lower bound. Contract: none.
// $IPC_TOOLKIT is the folder in which ipc-toolkit is installed:
//
//   tools/subject --pkg-config 'eigen3 spdlog' fuzz/subjects/peers/additive.cpp --
//       -I$IPC_TOOLKIT/include $IPC_TOOLKIT/lib/libipc_toolkit.a
#include <ipc/ccd/additive_ccd.hpp>

#include "ccd/nearmiss_functions.hpp"

namespace {

using nearmiss::plugin::Answer;
using nearmiss::plugin::Question;

struct Settings {
  double rescaling = ipc::AdditiveCCD::DEFAULT_CONSERVATIVE_RESCALING;
  double iterations = ipc::AdditiveCCD::UNLIMITTED_ITERATIONS;
};

constexpr std::array<nearmiss::Option<Settings>, 2> settings{
    {{"rescaling", &Settings::rescaling, 1e-3, 1}, {"iterations", &Settings::iterations, -1, 1e15}}};

Answer decide(const Settings& set, const Question& q) {
  const ipc::AdditiveCCD ccd(static_cast<long>(set.iterations), set.rescaling);
  double toi = 0;
  const bool collides = with_vertices(q, [&](const auto&... v) {
    return q.kind == NEARMISS_VERTEX_TRIANGLE ? ccd.point_triangle_ccd(v..., toi, q.separation)
                                              : ccd.edge_edge_ccd(v..., toi, q.separation);
  });
  return Answer::of(collides, toi);
}

}  // namespace

NEARMISS_SUBJECT(detector("additive", "b40e9c07",
                          "additive CCD of ipc-toolkit, conservative advancement; options rescaling=0.9, "
                          "iterations=-1 (no limit)")
                     .options<settings>()
                     .vertex_triangle(decide)
                     .edge_edge(decide)
                     .set(&nearmiss_subject::time_sort, NEARMISS_TIME_LOWER_BOUND)
                     .set(&nearmiss_subject::takes_separation, 1))
