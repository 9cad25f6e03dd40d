// Additive CCD in the code of its authors, Library/Math/Distance/CCD.h of Codim-IPC (ipc-sim/Codim-IPC,
// 9c6cbe3, Apache-2.0), from which other solvers have copied it.
//
// It is asked as Compute_Intersection_Free_StepSize() in Library/FEM/IPC.h asks it: first whether the boxes
// of the two motions come within the thickness, then with eta = 0.1 and a step size of 1, the largest
// allowed. The time is taken as the step, and so a lower bound. It also decides two vertices, and a vertex
// and an edge. The separation is its thickness. It gets displacements, which are rounded; the solver
// computes the ends from them.
//
// Contract: the primitives are farther apart at the start than the thickness. The solver keeps that
// invariant, and the code divides by the distance.
//
// Option eta=0.1: the share of the distance that remains.
//
// Its headers include pybind11:
//
//   tools/subject fuzz/subjects/peers/codim-ipc.cpp -- -I$CODIM_IPC/Library -I/usr/include/eigen3
//     $(python3-config --includes --ldflags --embed)
#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include <Math/Distance/CCD.h>

#include "fuzz/subjects/peers/adapter.hpp"

namespace nearmiss::peers {
namespace {

struct Settings {
  double eta = 0.1;
};

constexpr std::array<Option<Settings>, 1> options{{{"eta", &Settings::eta, 1e-3, 0.999}}};

Answer ask(double eta, int kind, const double* x, double thickness) {
  using Vector = Eigen::Vector3d;
  const int vertices = kind == NEARMISS_VERTEX_VERTEX ? 2 : kind == NEARMISS_VERTEX_EDGE ? 3 : 4;
  const auto v = [&](int vertex) { return Vector(Eigen::Map<const Vector>(x + 3 * vertex)); };
  const auto d = [&](int vertex) { return Vector(v(vertices + vertex) - v(vertex)); };
  double step = 1;
  bool collides = false;
  switch (kind) {
    case NEARMISS_VERTEX_VERTEX:
      collides = JGSL::Point_Point_CCD_Broadphase(v(0), v(1), d(0), d(1), thickness) &&
                 JGSL::Point_Point_CCD(v(0), v(1), d(0), d(1), eta, thickness, step);
      break;
    case NEARMISS_VERTEX_EDGE:
      collides = JGSL::Point_Edge_CCD_Broadphase(v(0), v(1), v(2), d(0), d(1), d(2), thickness) &&
                 JGSL::Point_Edge_CCD(v(0), v(1), v(2), d(0), d(1), d(2), eta, thickness, step);
      break;
    case NEARMISS_VERTEX_TRIANGLE:
      collides =
          JGSL::Point_Triangle_CCD_Broadphase(v(0), v(1), v(2), v(3), d(0), d(1), d(2), d(3), thickness) &&
          JGSL::Point_Triangle_CCD(v(0), v(1), v(2), v(3), d(0), d(1), d(2), d(3), eta, thickness, step);
      break;
    default:
      collides = JGSL::Edge_Edge_CCD_Broadphase(v(0), v(1), v(2), v(3), d(0), d(1), d(2), d(3), thickness) &&
                 JGSL::Edge_Edge_CCD(v(0), v(1), v(2), v(3), d(0), d(1), d(2), d(3), eta, thickness, step);
  }
  return Answer::of(collides, step);
}

void decide(void* state, int kind, std::size_t n, const double* x, const double* h, int* answer,
            double* toi) {
  const std::size_t row = kind == NEARMISS_VERTEX_VERTEX ? 12 : kind == NEARMISS_VERTEX_EDGE ? 18 : 24;
  for (std::size_t i = 0; i < n; ++i) {
    const Answer said = ask(static_cast<const Settings*>(state)->eta, kind, x + row * i, h[i]);
    answer[i] = said.value;
    toi[i] = said.time;
  }
}

nearmiss_subject subject() {
  nearmiss_subject subject{};
  subject.interface_version = NEARMISS_INTERFACE;
  subject.name = "codim-ipc";
  subject.version = "9c6cbe3";
  subject.about = "additive CCD in its authors' code, as Codim-IPC asks it; option eta=0.1";
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
