// GIPC's additive CCD (Huang and others, "GIPC: fast and stable Gauss-Newton optimization of IPC barrier
// energy", 2024), GPU_IPC/ACCD.cu. It is CUDA code, here compiled for the host. On a GPU, the compiler fuses
// multiplications with additions, which may change the last bits. This adapter calls the code as
// _reduct_min_selfTimeStep_to_double() in GIPC.cu does, with eta = 0.2 and thickness 0. The code gives a time
// up to which the step is safe; a time below 1 counts as a collision. After 50,000 iterations, the code gives
// the time that it has reached.
// Source: github.com/KemengHuang/GPU_IPC, 46594e0. Licence: MPL 2.0.
// Question: contact; the time of impact is a lower bound. The code takes displacements, which this adapter
// computes with rounding errors. The option eta is the share of the distance at t = 0 that remains at the
// time of impact that the code gives.
// Contract: the primitives are apart at t = 0. The solver ensures that they are, and the code relies on this,
// because it divides by the distance.
// $GPU_IPC is the repository, and $CUDA is the folder of CUDA's headers. No GPU is needed:
//
//   tools/subject --pkg-config eigen3 fuzz/subjects/peers/gipc.cpp -- -I$GPU_IPC/GPU_IPC -I$CUDA/include
//       -x c++ $GPU_IPC/GPU_IPC/ACCD.cu $GPU_IPC/GPU_IPC/gpu_eigen_libs.cu
#include <ACCD.cuh>

#include "ccd/nearmiss_functions.hpp"

namespace {

using nearmiss::plugin::Answer;
using nearmiss::plugin::Question;

struct Settings {
  double eta = 1 - 0.8;  // slackness_m in GIPC.cu
};

constexpr std::array<nearmiss::Option<Settings>, 1> settings{{{"eta", &Settings::eta, 1e-3, 0.999}}};

Answer decide(const Settings& set, const Question& q) {
  const auto test = q.kind == NEARMISS_VERTEX_TRIANGLE ? point_triangle_ccd : edge_edge_ccd;
  const double step = with_displacements(q, [&](const auto&... v) { return test(v..., set.eta, 0); });
  return Answer::of(!(step >= 1), step);
}

}  // namespace

NEARMISS_SUBJECT(detector("gipc", "46594e0",
                          "GIPC's additive CCD, compiled for the host, as its solver asks it; option eta=0.2")
                     .options<settings>()
                     .vertex_triangle(decide)
                     .edge_edge(decide)
                     .set(&nearmiss_subject::time_sort, NEARMISS_TIME_LOWER_BOUND)
                     .set(&nearmiss_contract::apart_at_start, 1))
