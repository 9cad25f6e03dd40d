// libuipc's additive CCD, src/backends/cuda/utils/distance/ccd.h (spiriMirror/libuipc, 619a5412,
// Apache-2.0). It is CUDA code for the host as well, and is compiled for the host here. On a GPU, the
// compiler fuses multiplications with additions, so that the last bits may differ.
//
// It is asked as the filters in src/backends/cuda/collision_detection/filters ask it
// (lbvh_simplex_trajectory_filter.cu: filter_toi): first whether the boxes of the two motions come within
// d_hat + thickness, then with eta = 0.1, at most 1000 iterations, and 1.1 as the time that stands for
// "none". It also reports contact after the step, up to t = 1.1: such a time does not shorten the step, and
// counts as no collision. If the iterations run out, it takes the time that it has reached for a collision,
// which is still a lower bound. The separation is its thickness. It gets displacements, which are rounded.
// It also decides two vertices, and a vertex and an edge.
//
// Contract: the primitives are farther apart at the start than the thickness. The solver keeps that
// invariant, and the code divides by the distance.
//
// Option d-hat=0.01: its default for contact (the boxes' margin).
//
// It needs muda (MuGdxy/muda), and the headers of CUDA, but no GPU:
//
//   tools/subject fuzz/subjects/peers/libuipc.cpp -- -std=c++20 -I$LIBUIPC/src/backends/cuda
//     -I$LIBUIPC/include -I$MUDA/src -I/usr/local/cuda/include -I/usr/local/cuda/include/cccl
//     -I/usr/include/eigen3
#include <Eigen/Dense>
#include <algorithm>

#include <utils/distance/distance_flagged.h>

#include <utils/distance/ccd.h>

#include "fuzz/subjects/peers/adapter.hpp"

namespace nearmiss::peers {
namespace {

struct Settings {
  double d_hat = 0.01;
};

constexpr std::array<Option<Settings>, 1> options{{{"d-hat", &Settings::d_hat, 0, 1e300}}};

constexpr double eta = 0.1;  // what the filters fix in their code
constexpr int most_iterations = 1000;
constexpr double none = 1.1;

Answer ask(double d_hat, int kind, const double* x, double h) {
  namespace uipc = uipc::backend::cuda::distance;
  using Vector = Eigen::Vector3d;
  const int vertices = kind == NEARMISS_VERTEX_VERTEX ? 2 : kind == NEARMISS_VERTEX_EDGE ? 3 : 4;
  const auto v = [&](int vertex) { return Vector(Eigen::Map<const Vector>(x + 3 * vertex)); };
  const auto d = [&](int vertex) { return Vector(v(vertices + vertex) - v(vertex)); };
  const double reach = d_hat + h;
  const int n = most_iterations;
  double toi = none;
  bool hit = false;
  switch (kind) {
    case NEARMISS_VERTEX_VERTEX:
      hit = uipc::point_point_ccd_broadphase(v(0), v(1), d(0), d(1), reach) &&
            uipc::point_point_ccd(v(0), v(1), d(0), d(1), eta, h, n, toi);
      break;
    case NEARMISS_VERTEX_EDGE:
      hit = uipc::point_edge_ccd_broadphase(v(0), v(1), v(2), d(0), d(1), d(2), reach) &&
            uipc::point_edge_ccd(v(0), v(1), v(2), d(0), d(1), d(2), eta, h, n, toi);
      break;
    case NEARMISS_VERTEX_TRIANGLE:
      hit = uipc::point_triangle_ccd_broadphase(v(0), v(1), v(2), v(3), d(0), d(1), d(2), d(3), reach) &&
            uipc::point_triangle_ccd(v(0), v(1), v(2), v(3), d(0), d(1), d(2), d(3), eta, h, n, toi);
      break;
    default:
      hit = uipc::edge_edge_ccd_broadphase(v(0), v(1), v(2), v(3), d(0), d(1), d(2), d(3), reach) &&
            uipc::edge_edge_ccd(v(0), v(1), v(2), v(3), d(0), d(1), d(2), d(3), eta, h, n, toi);
  }
  return Answer::of(hit && !(toi > 1), toi);
}

void decide(void* state, int kind, std::size_t n, const double* x, const double* h, int* answer,
            double* toi) {
  const std::size_t row = kind == NEARMISS_VERTEX_VERTEX ? 12 : kind == NEARMISS_VERTEX_EDGE ? 18 : 24;
  for (std::size_t i = 0; i < n; ++i) {
    const Answer said = ask(static_cast<const Settings*>(state)->d_hat, kind, x + row * i, h[i]);
    answer[i] = said.value;
    toi[i] = said.time;
  }
}

nearmiss_subject subject() {
  nearmiss_subject subject{};
  subject.interface_version = NEARMISS_INTERFACE;
  subject.name = "libuipc";
  subject.version = "619a5412";
  subject.about = "libuipc's additive CCD, compiled for the host, as its filters ask it; option d-hat=0.01";
  subject.kinds =
      NEARMISS_VERTEX_TRIANGLE + NEARMISS_EDGE_EDGE + NEARMISS_VERTEX_VERTEX + NEARMISS_VERTEX_EDGE;
  subject.time_sort = NEARMISS_TIME_LOWER_BOUND;
  subject.takes_separation = 1;
  subject.contract.apart_at_start = 1;
  subject.decide = decide;
  take_options<Settings, options>(subject);
  return subject;
}

}  // namespace
}  // namespace nearmiss::peers

const nearmiss_subject* nearmiss_get_subject(std::size_t index) {
  return nearmiss::peers::numbered<nearmiss::peers::subject>(index);
}
