// Additive CCD in the code of its authors (Li, Kaufman and Jiang, "Codimensional incremental potential
// contact", 2021), Library/Math/Distance/CCD.h, a file that other solvers have copied. This adapter does what
// Compute_Intersection_Free_StepSize() in Library/FEM/IPC.h does: it first asks whether the boxes of the two
// motions come within the thickness of each other, and, if they do, calls the CCD with eta = 0.1. The time is
// the largest step that the CCD allows.
// Source: github.com/ipc-sim/Codim-IPC, 9c6cbe3. Licence: Apache 2.0.
// Question: contact, or a separation, which the code calls thickness. The time of impact is a lower bound.
// The code takes displacements, which this adapter computes with rounding errors. The option eta is the share
// of the distance at t = 0 that remains at the given time.
// Contract: the primitives are farther apart at t = 0 than the thickness. The solver ensures that they are.
// The code relies on this, because it divides by the distance.
// $CODIM_IPC is the repository, whose headers contain the whole code, and include pybind11:
//
//   tools/subject --pkg-config 'eigen3 python3-embed' fuzz/subjects/peers/codim-ipc.cpp --
//       -I$CODIM_IPC/Library
#include <Eigen/Dense>
#include <algorithm>
#include <vector>
// The header below uses the three headers above without including them.
#include <Math/Distance/CCD.h>

#include "ccd/nearmiss_functions.hpp"

namespace {

using nearmiss::plugin::Answer;
using nearmiss::plugin::Question;

struct Settings {
  double eta = 0.1;
};

constexpr std::array<nearmiss::Option<Settings>, 1> settings{{{"eta", &Settings::eta, 1e-3, 0.999}}};

/// Converts a vertex to Eigen::Vector3d, because the CCD's templates deduce the type of the vertex's
/// coordinates.
Eigen::Vector3d vector(const Eigen::Vector3d& vertex) { return vertex; }

/// Makes a function that decides a query with n vertices. If the boxes meet, that function asks the CCD;
/// otherwise, it reports no collision.
template <std::size_t n, class Boxes, class Test>
auto after_boxes(Boxes boxes, Test test) {
  return [=](const Settings& set, const Question& q) {
    double step = 1;
    const bool collides = nearmiss::plugin::with_displacements<n>(q, [&](const auto&... v) {
      return boxes(vector(v)..., q.separation) && test(vector(v)..., set.eta, q.separation, step);
    });
    return Answer::of(collides, step);
  };
}

}  // namespace

NEARMISS_SUBJECT(detector("codim-ipc", "9c6cbe3",
                          "additive CCD in its authors' code, as Codim-IPC asks it; option eta=0.1")
                     .options<settings>()
                     .vertex_triangle(after_boxes<4>(NEARMISS_CALL(JGSL::Point_Triangle_CCD_Broadphase),
                                                     NEARMISS_CALL(JGSL::Point_Triangle_CCD)))
                     .edge_edge(after_boxes<4>(NEARMISS_CALL(JGSL::Edge_Edge_CCD_Broadphase),
                                               NEARMISS_CALL(JGSL::Edge_Edge_CCD)))
                     .vertex_vertex(after_boxes<2>(NEARMISS_CALL(JGSL::Point_Point_CCD_Broadphase),
                                                   NEARMISS_CALL(JGSL::Point_Point_CCD)))
                     .vertex_edge(after_boxes<3>(NEARMISS_CALL(JGSL::Point_Edge_CCD_Broadphase),
                                                 NEARMISS_CALL(JGSL::Point_Edge_CCD)))
                     .set(&nearmiss_subject::time_sort, NEARMISS_TIME_LOWER_BOUND)
                     .set(&nearmiss_subject::takes_separation, 1)
                     .set(&nearmiss_contract::apart_at_start, 1))
