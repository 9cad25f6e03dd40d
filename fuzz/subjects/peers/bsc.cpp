// Bernstein sign classification (Tang, Tong, Wang and Manocha, "Fast and exact continuous collision detection
// with Bernstein sign classification", 2014), with the arithmetic of root parity.
// Source: github.com/Continuous-Collision-Detection/Root-Parity-and-Bernstein-Sign-Classification, 8db61b2c.
// Licence: research, no fee (LICENSE.BSC.txt).
// Question: contact. Contract: none. If the cubic has an inflection point in the time step, the code throws
// an exception, so the query has no answer. The authors say that they do not handle this case exactly.
// $BSC is the repository, with its code compiled into libbsc.a (if the compiler is g++, with
// -frounding-math):
//
//   tools/subject fuzz/subjects/peers/bsc.cpp -- -I$BSC $BSC/libbsc.a
#include <algorithm>
#include <cstddef>
#include <stdexcept>
// <bsc.h> uses the three headers above without including them.
#include <bsc.h>

#include "ccd/nearmiss_functions.hpp"

namespace {

using nearmiss::plugin::Answer;
using nearmiss::plugin::Question;

/// Passes the triangle first and the vertex last, as this code expects.
Answer vertex_triangle(const Question& q) {
  return Answer::of(bsc::Intersect_VF_robust(q.start(1), q.start(2), q.start(3), q.start(0), q.end(1),
                                             q.end(2), q.end(3), q.end(0)));
}

}  // namespace

NEARMISS_SUBJECT(
    detector(
        "bsc", "2014",
        "Bernstein sign classification, exact; throws if the cubic has an inflection point in the time step")
        .vertex_triangle(vertex_triangle)
        .edge_edge(bsc::Intersect_EE_robust))
