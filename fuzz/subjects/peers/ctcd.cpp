// CTCD, Etienne Vouga's library, which asks whether primitives come within a thickness eta, with a numerical
// solver for polynomials of degree up to 6 (evouga/collisiondetection, e5fe5c9, no licence stated).
//
// It is asked as its own narrow phase asks it (src/CTCDNarrowPhase.cpp): for a vertex and a triangle, also
// about the vertex and each edge and corner; for two edges, also about each end and the other edge, and
// each two ends. "WARNING: Does not work correctly if two edges are parallel at the time of intersection --
// vertexEdgeCTCD should catch this case", says its header. The narrow phase uses no times, and none is
// passed on.
//
// Contract: at the start, the primitives are farther apart than eta. Its velocity filter refuses a start
// that is closer (STARTING_STATE_INTERSECTS in VelocityFilter.h).
//
// The separation is eta, but at least 1e-6, which stands for contact, as in its example/testCTCD.cpp: an eta
// of 0 finds no collision. Option eta=1e-6.
//
//   tools/subject fuzz/subjects/peers/ctcd.cpp -- -I$CTCD/include -I/usr/include/eigen3 $CTCD/src/CTCD.cpp
#include <CTCD.h>

#include <algorithm>

#include "fuzz/subjects/peers/adapter.hpp"

namespace nearmiss::peers {
namespace {

constexpr double contact = 1e-6;

struct Settings {
  double eta = contact;
};

constexpr std::array<Option<Settings>, 1> options{{{"eta", &Settings::eta, contact, 1e300}}};

Answer ask(double eta, int kind, const double* x) {
  const int end = kind == NEARMISS_VERTEX_VERTEX ? 2 : kind == NEARMISS_VERTEX_EDGE ? 3 : 4;
  const auto v = [&](int vertex) {
    return Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(x + 3 * vertex));
  };
  double t = 0;
  const auto vertices = [&](int a, int b) {
    return CTCD::vertexVertexCTCD(v(a), v(b), v(end + a), v(end + b), eta, t);
  };
  const auto vertex_edge = [&](int a, int b, int c) {
    return CTCD::vertexEdgeCTCD(v(a), v(b), v(c), v(end + a), v(end + b), v(end + c), eta, t);
  };
  switch (kind) {
    case NEARMISS_VERTEX_VERTEX:
      return Answer::of(vertices(0, 1));
    case NEARMISS_VERTEX_EDGE:
      return Answer::of(vertex_edge(0, 1, 2) || vertices(0, 1) || vertices(0, 2));
    case NEARMISS_VERTEX_TRIANGLE:
      return Answer::of(CTCD::vertexFaceCTCD(v(0), v(1), v(2), v(3), v(4), v(5), v(6), v(7), eta, t) ||
                        vertex_edge(0, 1, 2) || vertex_edge(0, 2, 3) || vertex_edge(0, 3, 1) ||
                        vertices(0, 1) || vertices(0, 2) || vertices(0, 3));
    default:
      return Answer::of(CTCD::edgeEdgeCTCD(v(0), v(1), v(2), v(3), v(4), v(5), v(6), v(7), eta, t) ||
                        vertex_edge(0, 2, 3) || vertex_edge(1, 2, 3) || vertex_edge(2, 0, 1) ||
                        vertex_edge(3, 0, 1) || vertices(0, 2) || vertices(0, 3) || vertices(1, 2) ||
                        vertices(1, 3));
  }
}

void decide(void* state, int kind, std::size_t n, const double* x, const double* h, int* answer,
            double* /*toi*/) {
  const std::size_t row = kind == NEARMISS_VERTEX_VERTEX ? 12 : kind == NEARMISS_VERTEX_EDGE ? 18 : 24;
  const double eta = static_cast<const Settings*>(state)->eta;
  for (std::size_t i = 0; i < n; ++i) answer[i] = ask(std::max(h[i], eta), kind, x + row * i).value;
}

nearmiss_subject subject() {
  nearmiss_subject subject{};
  subject.interface_version = NEARMISS_INTERFACE;
  subject.name = "ctcd";
  subject.version = "e5fe5c9";
  subject.about =
      "CTCD with vertices and edges, as its narrow phase asks it; eta is at least the option eta=1e-6";
  subject.kinds =
      NEARMISS_VERTEX_TRIANGLE + NEARMISS_EDGE_EDGE + NEARMISS_VERTEX_VERTEX + NEARMISS_VERTEX_EDGE;
  subject.takes_separation = 1;
  subject.contract.apart_at_start = 1;
  subject.contract.apart_by = contact;
  subject.decide = decide;
  take_options<Settings, options>(subject);
  return subject;
}

}  // namespace
}  // namespace nearmiss::peers

const nearmiss_subject* nearmiss_get_subject(std::size_t index) {
  return nearmiss::peers::numbered<nearmiss::peers::subject>(index);
}
