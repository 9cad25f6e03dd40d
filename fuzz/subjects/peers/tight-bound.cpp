// Bernstein sign classification with a tight bound on rounding errors (Wang, Tang, Tong and Manocha,
// "TightCCD: efficient and robust continuous collision detection using tight error bounds", 2015). If a sign
// is uncertain, the code reports a collision in most cases.
// Source: github.com/Continuous-Collision-Detection/TightCCD, src, 366384ba. All rights reserved.
// Question: contact. Contract: none.
// $TIGHT_CCD is the repository; its header contains the whole code:
//
//   tools/subject fuzz/subjects/peers/tight-bound.cpp -- -isystem $TIGHT_CCD/src
#include <cassert>
// The header below uses <cassert> without including it.
#include <bsc_tightbound.h>

#include "ccd/nearmiss_functions.hpp"

namespace {

using nearmiss::plugin::Answer;
using nearmiss::plugin::Question;

/// Passes the triangle first and the vertex last, as this code expects.
Answer vertex_triangle(const Question& q) {
  return Answer::of(bsc_tightbound::Intersect_VF_robust(q.start(1), q.start(2), q.start(3), q.start(0),
                                                        q.end(1), q.end(2), q.end(3), q.end(0)));
}

}  // namespace

NEARMISS_SUBJECT(detector("tight-bound", "2015",
                          "Bernstein sign classification with a tight bound of rounding errors (TightCCD)")
                     .vertex_triangle(vertex_triangle)
                     .edge_edge(bsc_tightbound::Intersect_EE_robust))
