// The continuous collision detection for deformable meshes of FCL, the Flexible Collision Library, with each
// of its two solvers.
// Built with Debian's libfcl-dev 0.7.0. Licence: BSD.
// Question: contact; the time of impact is the root that the solver happens to find first. Contract: none.
//
//   tools/subject --pkg-config fcl fuzz/subjects/peers/fcl.cpp -- -std=c++17
#include <fcl/config.h>
#include <fcl/narrowphase/detail/traversal/collision/intersect.h>

#include "ccd/nearmiss_functions.hpp"

namespace {

using nearmiss::plugin::Answer;
using nearmiss::plugin::Question;
using Intersect = fcl::detail::Intersect<double>;

template <bool uses_newton>
Answer decide(const Question& q) {
  double time = 0;
  fcl::Vector3d where;
  // FCL takes the triangle first, and the vertex last.
  const bool collides =
      q.kind == NEARMISS_VERTEX_TRIANGLE
          ? Intersect::intersect_VF(q.start(1), q.start(2), q.start(3), q.start(0), q.end(1), q.end(2),
                                    q.end(3), q.end(0), &time, &where, uses_newton)
          : Intersect::intersect_EE(q.start(0), q.start(1), q.start(2), q.start(3), q.end(0), q.end(1),
                                    q.end(2), q.end(3), &time, &where, uses_newton);
  return Answer::of(collides, time);
}

template <bool uses_newton>
auto fcl_detector(const char* name, const char* about) {
  return nearmiss::plugin::detector(name, FCL_VERSION, about)
      .vertex_triangle(decide<uses_newton>)
      .edge_edge(decide<uses_newton>)
      .set(&nearmiss_subject::time_sort, NEARMISS_TIME_ESTIMATE);
}

}  // namespace

NEARMISS_SUBJECT(
    fcl_detector<false>("fcl", "FCL's CCD of deformable meshes, with its solver for cubics"),
    fcl_detector<true>("fcl-newton",
                       "FCL's CCD of deformable meshes, with interval Newton iteration (its default)"))
