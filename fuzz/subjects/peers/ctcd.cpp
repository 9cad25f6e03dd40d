// CTCD, Etienne Vouga's library. With a numerical solver for polynomials of degree up to 6, it decides
// whether primitives come within a thickness eta. This adapter asks CTCD the same questions as
// src/CTCDNarrowPhase.cpp. For a vertex and a triangle, it also asks about the vertex and each edge, and
// about the vertex and each corner. For two edges, it also asks about each end and the other edge, and about
// each end and each end of the other edge. CTCD's header says: "WARNING: Does not work correctly if two edges
// are parallel at the time of intersection -- vertexEdgeCTCD should catch this case". CTCD's narrow phase
// does not use the times of impact, so the adapter does not pass them on.
// Source: github.com/evouga/collisiondetection, e5fe5c9. Licence: none stated.
// Question: a separation, which becomes CTCD's eta. With an eta of 0, CTCD finds no collision. So eta is at
// least the option eta=1e-6, even if the query asks for contact, as in example/testCTCD.cpp.
// Contract: the primitives are farther apart at t = 0 than eta. CTCD's velocity filter refuses a start that
// is closer (STARTING_STATE_INTERSECTS in VelocityFilter.h).
// $CTCD is the repository:
//
//   tools/subject --pkg-config eigen3 fuzz/subjects/peers/ctcd.cpp -- -I$CTCD/include $CTCD/src/CTCD.cpp
#include <CTCD.h>

#include <algorithm>

#include "ccd/nearmiss_functions.hpp"

namespace {

using nearmiss::plugin::Answer;
using nearmiss::plugin::Question;

constexpr double contact = 1e-6;

struct Settings {
  double eta = contact;
};

constexpr std::array<nearmiss::Option<Settings>, 1> settings{{{"eta", &Settings::eta, contact, 1e300}}};

Answer decide(const Settings& set, const Question& q) {
  const double eta = std::max(q.separation, set.eta);
  double t = 0;
  const auto with = [&](const auto& ask, auto... i) { return ask(q.start(i)..., q.end(i)..., eta, t); };
  const auto vertices = [&](auto... i) { return with(CTCD::vertexVertexCTCD, i...); };
  const auto vertex_edge = [&](auto... i) { return with(CTCD::vertexEdgeCTCD, i...); };
  switch (q.kind) {
    case NEARMISS_VERTEX_VERTEX:
      return Answer::of(vertices(0, 1));
    case NEARMISS_VERTEX_EDGE:
      return Answer::of(vertex_edge(0, 1, 2) || vertices(0, 1) || vertices(0, 2));
    case NEARMISS_VERTEX_TRIANGLE:
      return Answer::of(with(CTCD::vertexFaceCTCD, 0, 1, 2, 3) || vertex_edge(0, 1, 2) ||
                        vertex_edge(0, 2, 3) || vertex_edge(0, 3, 1) || vertices(0, 1) || vertices(0, 2) ||
                        vertices(0, 3));
    default:
      return Answer::of(with(CTCD::edgeEdgeCTCD, 0, 1, 2, 3) || vertex_edge(0, 2, 3) ||
                        vertex_edge(1, 2, 3) || vertex_edge(2, 0, 1) || vertex_edge(3, 0, 1) ||
                        vertices(0, 2) || vertices(0, 3) || vertices(1, 2) || vertices(1, 3));
  }
}

}  // namespace

NEARMISS_SUBJECT(
    detector("ctcd", "e5fe5c9",
             "CTCD with vertices and edges, as its narrow phase asks it; eta is at least the option eta=1e-6")
        .options<settings>()
        .vertex_triangle(decide)
        .edge_edge(decide)
        .vertex_vertex(decide)
        .vertex_edge(decide)
        .set(&nearmiss_subject::takes_separation, 1)
        .set(&nearmiss_contract::apart_at_start, 1)
        .set(&nearmiss_contract::apart_by, contact))
