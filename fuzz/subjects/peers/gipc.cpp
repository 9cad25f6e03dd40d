// GIPC's additive CCD, GPU_IPC/ACCD.cu (KemengHuang/GPU_IPC, 46594e0, MPL-2.0). It is CUDA code, and is
// compiled for the host here. On a GPU, the compiler fuses multiplications with additions, so that the last
// bits may differ.
//
// It is asked as _reduct_min_selfTimeStep_to_double() in GIPC.cu asks it, with an eta of 1 - 0.8 and
// thickness 0. It answers how far the step may go; less than 1 counts as a collision not before that time.
// After 50,000 iterations, it takes the time that it has reached, still a lower bound. It gets
// displacements, which are rounded; the solver computes the ends from them.
//
// Contract: the primitives do not touch at the start. The solver keeps that invariant, and the code divides
// by the distance.
//
// Option eta=0.2: the share of the distance that remains.
//
// It needs the headers of CUDA, but no GPU:
//
//   tools/subject fuzz/subjects/peers/gipc.cpp -- -I$GPU_IPC/GPU_IPC -I/usr/local/cuda/include
//     -I/usr/include/eigen3 -x c++ $GPU_IPC/GPU_IPC/ACCD.cu $GPU_IPC/GPU_IPC/gpu_eigen_libs.cu
#include <ACCD.cuh>

#include "fuzz/subjects/peers/adapter.hpp"

namespace nearmiss::peers {
namespace {

struct Settings {
  double eta = 1 - 0.8;  // slackness_m in GIPC.cu
};

constexpr std::array<Option<Settings>, 1> options{{{"eta", &Settings::eta, 1e-3, 0.999}}};

Answer decide(const void* state, int kind, const Question& q) {
  const double eta = static_cast<const Settings*>(state)->eta;
  const auto v = [&](int i) { return double3{q.start(i)[0], q.start(i)[1], q.start(i)[2]}; };
  const auto d = [&](int i) {
    return double3{q.end(i)[0] - q.start(i)[0], q.end(i)[1] - q.start(i)[1], q.end(i)[2] - q.start(i)[2]};
  };
  const auto test = kind == NEARMISS_VERTEX_TRIANGLE ? point_triangle_ccd : edge_edge_ccd;
  const double step = test(v(0), v(1), v(2), v(3), d(0), d(1), d(2), d(3), eta, 0);
  return Answer::of(!(step >= 1), step);
}

nearmiss_subject subject() {
  nearmiss_subject subject = detector<decide>(
      "gipc", "46594e0", "GIPC's additive CCD, compiled for the host, as its solver asks it; option eta=0.2");
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
