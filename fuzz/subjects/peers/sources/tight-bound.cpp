// Bernstein sign classification with a tight bound of the rounding errors (Wang, Tang, Tong and Manocha,
// "TightCCD: efficient and robust continuous collision detection using tight error bounds", 2015). If a sign
// is uncertain, it reports a collision in most cases.
#include <cassert>
// This header contains the whole code, and uses a standard header that it does not include.
#include <bsc_tightbound.h>

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
    return Answer::of(bsc_tightbound::Intersect_VF_robust(start[1], start[2], start[3], start[0], end[1],
                                                          end[2], end[3], end[0]));
  return Answer::of(bsc_tightbound::Intersect_EE_robust(start[0], start[1], start[2], start[3], end[0],
                                                        end[1], end[2], end[3]));
}

nearmiss_subject subject() {
  return detector<decide>("tight-bound", "2015",
                          "Bernstein sign classification with a tight bound of rounding errors (TightCCD)");
}

}  // namespace
}  // namespace nearmiss::peers

const nearmiss_subject* nearmiss_get_subject(std::size_t index) {
  return nearmiss::peers::numbered<nearmiss::peers::subject>(index);
}
