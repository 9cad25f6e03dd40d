// FCL, the Flexible Collision Library: the continuous collision detection of its deformable meshes, with each
// of its two solvers.
#include <fcl/config.h>
#include <fcl/narrowphase/detail/traversal/collision/intersect.h>

#include "fuzz/subjects/peers/adapter.hpp"

namespace nearmiss::peers {
namespace {

using Vector = Eigen::Map<const fcl::Vector3d>;
using Intersect = fcl::detail::Intersect<double>;

template <bool uses_newton>
Answer decide(const void* /*state*/, int kind, const Question& q) {
  double time = 0;
  fcl::Vector3d where;
  const auto start = [&](int vertex) { return fcl::Vector3d(Vector(q.start(vertex))); };
  const auto end = [&](int vertex) { return fcl::Vector3d(Vector(q.end(vertex))); };
  // FCL wants the triangle first, and the vertex last.
  const bool collides = kind == NEARMISS_VERTEX_TRIANGLE
                            ? Intersect::intersect_VF(start(1), start(2), start(3), start(0), end(1), end(2),
                                                      end(3), end(0), &time, &where, uses_newton)
                            : Intersect::intersect_EE(start(0), start(1), start(2), start(3), end(0), end(1),
                                                      end(2), end(3), &time, &where, uses_newton);
  return Answer::of(collides, time);
}

template <bool uses_newton>
nearmiss_subject subject() {
  nearmiss_subject subject = detector<decide<uses_newton>>(
      uses_newton ? "fcl-newton" : "fcl", FCL_VERSION,
      uses_newton ? "FCL's CCD of deformable meshes, with interval Newton iteration (its default)"
                  : "FCL's CCD of deformable meshes, with its solver for cubics");
  subject.time_sort = NEARMISS_TIME_ESTIMATE;  // of the first root that its solver happens to find
  return subject;
}

}  // namespace
}  // namespace nearmiss::peers

const nearmiss_subject* nearmiss_get_subject(std::size_t index) {
  return nearmiss::peers::numbered<nearmiss::peers::subject<false>, nearmiss::peers::subject<true>>(index);
}
