// Two CCDs of ipc-toolkit. This adapter calls them as ipc-toolkit's classes of candidate pairs do
// (src/ipc/candidates/). Below, d0 is the distance at t = 0, less the separation:
//
//   ipc-tight-inclusion  TightInclusionCCD, its default: Tight-Inclusion with a minimum distance of
//                        min(0.2 d0, 1e-4)
//   ipc-inexact          InexactCCD, the original method of IPC, off by default: CTCD with a
//                        minimum distance of 0.2 d0
//
// A CCD that finds a time below 1e-6 starts again, with only the separation as the minimum distance, and
// answers with 0.8 of the new time. The minimum distance makes room for the barrier; by design, it turns some
// near misses into collisions.
// Source: github.com/ipc-sim/ipc-toolkit, b40e9c07, with CTCD from github.com/evouga/collisiondetection,
// e5fe5c9. Licence: MIT; CTCD states none.
// Question: contact, or a separation; the time of impact is a lower bound. Contract: none. Primitives that
// touch at t = 0 collide at time 0 (check_initial_distance.hpp).
// $IPC_TOOLKIT is the folder in which ipc-toolkit is installed. Without IPC_TOOLKIT_WITH_INEXACT_CCD,
// ipc-inexact and evouga_ccd are left out:
//
//   tools/subject --pkg-config 'eigen3 spdlog' fuzz/subjects/peers/ipc-toolkit.cpp --
//       -I$IPC_TOOLKIT/include $IPC_TOOLKIT/lib/lib{ipc_toolkit,tight_inclusion,evouga_ccd}.a
#include <ipc/ccd/inexact_ccd.hpp>
#include <ipc/ccd/tight_inclusion_ccd.hpp>
#include <ipc/distance/edge_edge.hpp>
#include <ipc/distance/point_edge.hpp>
#include <ipc/distance/point_point.hpp>
#include <ipc/distance/point_triangle.hpp>

#include "ccd/nearmiss_functions.hpp"

namespace {

using nearmiss::plugin::squared;

template <class Ccd>
auto ipc_detector(const char* name, const char* about) {
  return nearmiss::plugin::detector(name, "b40e9c07", about)
      .vertex_triangle(NEARMISS_CALL(Ccd().point_triangle_ccd))
      .edge_edge(NEARMISS_CALL(Ccd().edge_edge_ccd))
      .vertex_vertex(NEARMISS_CALL(Ccd().point_point_ccd))
      .vertex_edge(NEARMISS_CALL(Ccd().point_edge_ccd))
      .vertex_triangle_distance(squared(NEARMISS_CALL(ipc::point_triangle_distance)))
      .edge_edge_distance(squared(NEARMISS_CALL(ipc::edge_edge_distance)))
      .vertex_vertex_distance(squared(NEARMISS_CALL(ipc::point_point_distance)))
      .vertex_edge_distance(squared(NEARMISS_CALL(ipc::point_edge_distance)));
}

auto tight_inclusion() {
  return ipc_detector<ipc::TightInclusionCCD>(
      "ipc-tight-inclusion",
      "Tight-Inclusion as ipc-toolkit asks it, with a minimum distance of min(0.2 d0, 1e-4)");
}

}  // namespace

#ifdef IPC_TOOLKIT_WITH_INEXACT_CCD
NEARMISS_SUBJECT(tight_inclusion(),
                 ipc_detector<ipc::InexactCCD>(
                     "ipc-inexact",
                     "CTCD as ipc-toolkit's InexactCCD asks it, with a minimum distance of 0.2 d0"))
#else
NEARMISS_SUBJECT(tight_inclusion())
#endif
