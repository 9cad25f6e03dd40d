// libuipc's additive CCD, src/backends/cuda/utils/distance/ccd.h. It is CUDA code for both device and host,
// here compiled for the host. On a GPU, the compiler fuses multiplications with additions, which may change
// the last bits. This adapter does what filter_toi() in lbvh_simplex_trajectory_filter.cu does: it first asks
// whether the boxes of the two motions come within d_hat + thickness of each other, and then calls the CCD
// with eta = 0.1 and at most 1000 iterations. If the iterations run out, the CCD reports a collision at the
// time that it has reached. The CCD looks for contact until t = 1.1; a time after 1 does not shorten the
// step, and counts as no collision.
// Source: github.com/spiriMirror/libuipc, 619a5412, with github.com/MuGdxy/muda, 6c752f9c. Licence: Apache
// 2.0.
// Question: contact, or a separation, which libuipc calls thickness. The time of impact is a lower bound. The
// code takes displacements, which this adapter computes with rounding errors. The option d-hat is the margin
// of the boxes; its default, 0.01, is libuipc's.
// Contract: the primitives are farther apart at t = 0 than the thickness. The solver ensures that they are,
// and the code relies on this, because it divides by the distance.
// $LIBUIPC and $MUDA are the repositories, and $CUDA is the folder of CUDA's headers. No GPU is needed:
//
//   tools/subject --pkg-config eigen3 fuzz/subjects/peers/libuipc.cpp -- -std=c++20
//       -I$LIBUIPC/src/backends/cuda -I$LIBUIPC/include -I$MUDA/src -I$CUDA/include -I$CUDA/include/cccl
#include <Eigen/Dense>
#include <algorithm>
// The two headers below use <Eigen/Dense> and <algorithm> without including them. ccd.h also uses
// distance_flagged.h.
#include <utils/distance/distance_flagged.h>

#include <utils/distance/ccd.h>

#include "ccd/nearmiss_functions.hpp"

namespace {

using nearmiss::plugin::Answer;
using nearmiss::plugin::Question;
namespace uipc_ccd = uipc::backend::cuda::distance;

struct Settings {
  double d_hat = 0.01;
};

constexpr std::array<nearmiss::Option<Settings>, 1> settings{{{"d-hat", &Settings::d_hat, 0, 1e300}}};

/// Converts a vertex to Eigen::Vector3d, because libuipc's templates deduce the type of the vertex's
/// coordinates.
Eigen::Vector3d vector(const Eigen::Vector3d& vertex) { return vertex; }

/// Makes a function that decides queries with n vertices. If the boxes meet, the function asks the CCD;
/// otherwise it reports no collision.
template <std::size_t n, class Boxes, class Test>
auto after_boxes(Boxes boxes, Test test) {
  return [=](const Settings& set, const Question& q) {
    double toi = 1.1;  // the CCD leaves this number unchanged if there is no contact
    const bool collides = nearmiss::plugin::with_displacements<n>(q, [&](const auto&... v) {
      return boxes(vector(v)..., set.d_hat + q.separation) &&
             test(vector(v)..., 0.1, q.separation, 1000, toi);
    });
    return Answer::of(collides && !(toi > 1), toi);
  };
}

}  // namespace

NEARMISS_SUBJECT(
    detector("libuipc", "619a5412",
             "libuipc's additive CCD, compiled for the host, as its filters ask it; option d-hat=0.01")
        .options<settings>()
        .vertex_triangle(after_boxes<4>(NEARMISS_CALL(uipc_ccd::point_triangle_ccd_broadphase),
                                        NEARMISS_CALL(uipc_ccd::point_triangle_ccd)))
        .edge_edge(after_boxes<4>(NEARMISS_CALL(uipc_ccd::edge_edge_ccd_broadphase),
                                  NEARMISS_CALL(uipc_ccd::edge_edge_ccd)))
        .vertex_vertex(after_boxes<2>(NEARMISS_CALL(uipc_ccd::point_point_ccd_broadphase),
                                      NEARMISS_CALL(uipc_ccd::point_point_ccd)))
        .vertex_edge(after_boxes<3>(NEARMISS_CALL(uipc_ccd::point_edge_ccd_broadphase),
                                    NEARMISS_CALL(uipc_ccd::point_edge_ccd)))
        .set(&nearmiss_subject::time_sort, NEARMISS_TIME_LOWER_BOUND)
        .set(&nearmiss_subject::takes_separation, 1)
        .set(&nearmiss_contract::apart_at_start, 1))
