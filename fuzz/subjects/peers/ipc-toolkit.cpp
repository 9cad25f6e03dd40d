// Two of ipc-toolkit's CCDs, as its candidates ask them (src/ipc/candidates/: the whole step, tmax = 1)
// (ipc-sim/ipc-toolkit, b40e9c07, MIT):
//
//   ipc-tight-inclusion  TightInclusionCCD, its default: Tight-Inclusion with a minimum distance of
//                        min(0.2 d0, 1e-4), where d0 is the distance at the start less the separation. If
//                        the time is below 1e-6, it asks again with the separation, never answers time 0,
//                        and takes 0.8 of the time.
//   ipc-inexact          InexactCCD, the original method of IPC, off by default: CTCD (e5fe5c9 of
//                        evouga/collisiondetection) with a minimum distance of 0.2 d0, and the same second
//                        attempt.
//
// Both also decide two vertices, and a vertex and an edge. They answer whether the primitives come within
// the separation, and give lower bounds of the time. A near miss may count as a collision, because the
// minimum distance makes room for the barrier: such a false positive is by design.
//
// Contract: none. Primitives that touch at the start collide at time 0 (check_initial_distance.hpp).
//
//   tools/subject fuzz/subjects/peers/ipc-toolkit.cpp -- -I$IPC/src -I$IPC_BUILD/include
//     -I/usr/include/eigen3 -L$IPC_BUILD -lipc_toolkit -ltight_inclusion -lspdlog -lfmt
//
// with IPC_TOOLKIT_WITH_INEXACT_CCD for both, and -levouga_ccd; without it, for the first.
#include <ipc/ccd/inexact_ccd.hpp>
#include <ipc/ccd/tight_inclusion_ccd.hpp>

#include "fuzz/subjects/peers/adapter.hpp"

namespace nearmiss::peers {
namespace {

template <class Ccd>
Answer ask(const Ccd& ccd, int kind, const double* x, double separation) {
  const int end = kind == NEARMISS_VERTEX_VERTEX ? 2 : kind == NEARMISS_VERTEX_EDGE ? 3 : 4;
  const auto v = [&](int vertex) {
    return Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(x + 3 * vertex));
  };
  double toi = 0;
  bool collides = false;
  switch (kind) {
    case NEARMISS_VERTEX_VERTEX:
      collides = ccd.point_point_ccd(v(0), v(1), v(end), v(end + 1), toi, separation);
      break;
    case NEARMISS_VERTEX_EDGE:
      collides = ccd.point_edge_ccd(v(0), v(1), v(2), v(end), v(end + 1), v(end + 2), toi, separation);
      break;
    case NEARMISS_VERTEX_TRIANGLE:
      collides = ccd.point_triangle_ccd(v(0), v(1), v(2), v(3), v(4), v(5), v(6), v(7), toi, separation);
      break;
    default:
      collides = ccd.edge_edge_ccd(v(0), v(1), v(2), v(3), v(4), v(5), v(6), v(7), toi, separation);
  }
  return Answer::of(collides, toi);
}

template <class Ccd>
void decide(void* /*state*/, int kind, std::size_t n, const double* x, const double* h, int* answer,
            double* toi) {
  const std::size_t row = kind == NEARMISS_VERTEX_VERTEX ? 12 : kind == NEARMISS_VERTEX_EDGE ? 18 : 24;
  for (std::size_t i = 0; i < n; ++i) {
    const Answer said = ask(Ccd(), kind, x + row * i, h[i]);
    answer[i] = said.value;
    toi[i] = said.time;
  }
}

template <class Ccd>
nearmiss_subject described(const char* name, const char* about) {
  nearmiss_subject subject{};
  subject.interface_version = NEARMISS_INTERFACE;
  subject.name = name;
  subject.version = "b40e9c07";
  subject.about = about;
  subject.kinds =
      NEARMISS_VERTEX_TRIANGLE + NEARMISS_EDGE_EDGE + NEARMISS_VERTEX_VERTEX + NEARMISS_VERTEX_EDGE;
  subject.time_sort = NEARMISS_TIME_LOWER_BOUND;
  subject.takes_separation = 1;
  subject.decide = decide<Ccd>;
  return subject;
}

nearmiss_subject tight_inclusion() {
  return described<ipc::TightInclusionCCD>(
      "ipc-tight-inclusion",
      "Tight-Inclusion as ipc-toolkit asks it, with a minimum distance of min(0.2 d0, 1e-4)");
}

#ifdef IPC_TOOLKIT_WITH_INEXACT_CCD
nearmiss_subject inexact() {
  return described<ipc::InexactCCD>(
      "ipc-inexact", "CTCD as ipc-toolkit's InexactCCD asks it, with a minimum distance of 0.2 d0");
}
#endif

}  // namespace
}  // namespace nearmiss::peers

const nearmiss_subject* nearmiss_get_subject(std::size_t index) {
#ifdef IPC_TOOLKIT_WITH_INEXACT_CCD
  return nearmiss::peers::numbered<nearmiss::peers::tight_inclusion, nearmiss::peers::inexact>(index);
#else
  return nearmiss::peers::numbered<nearmiss::peers::tight_inclusion>(index);
#endif
}
