// Bernstein sign classification (Tang, Tong, Wang and Manocha, "Fast and exact continuous collision detection
// with Bernstein sign classification", 2014), over root parity's arithmetic. It throws an exception for a
// cubic with an inflection point in the time step, which the authors say they do not handle exactly: such a
// query has no answer.
#include <bsc.h>

#include "fuzz/subjects/peers/adapter.hpp"

namespace nearmiss::peers {
namespace {

Answer decide(const void* /*state*/, int kind, const Question& q) {
  std::array<Vec3d, 4> start, end;
  for (int i = 0; i < 4; ++i) {
    start[static_cast<std::size_t>(i)] = Vec3d(q.start(i));
    end[static_cast<std::size_t>(i)] = Vec3d(q.end(i));
  }
  // The triangle comes first, and the vertex last.
  if (kind == NEARMISS_VERTEX_TRIANGLE)
    return Answer::of(
        bsc::Intersect_VF_robust(start[1], start[2], start[3], start[0], end[1], end[2], end[3], end[0]));
  return Answer::of(
      bsc::Intersect_EE_robust(start[0], start[1], start[2], start[3], end[0], end[1], end[2], end[3]));
}

nearmiss_subject subject() {
  return detector<decide>(
      "bsc", "2014",
      "Bernstein sign classification, exact; throws if the cubic has an inflection point in the time step");
}

}  // namespace
}  // namespace nearmiss::peers

const nearmiss_subject* nearmiss_get_subject(std::size_t index) {
  return nearmiss::peers::numbered<nearmiss::peers::subject>(index);
}
