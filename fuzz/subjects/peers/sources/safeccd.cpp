// The code that the author of the 2014 paper published with it (Wang, "Defending continuous collision detection against
// errors"), through the wrapper of the tree that it is taken from, which computes each pair's own bound B.
#include <safeCCDWrapper.h>

#include "fuzz/subjects/peers/adapter.hpp"

namespace nearmiss::peers {
namespace {

/// Makes the wrapper's function for B accessible.
struct Wrapper : SafeCCDWrapper {
  using SafeCCDWrapper::computeB;
};

Answer decide(const void* /*state*/, int kind, const Question& q) {
  double t = 0, r = 0, s = 0;  // it uses its weights even if nobody wants them
  const auto test =
      kind == NEARMISS_VERTEX_TRIANGLE ? SafeCCDWrapper::VertexTriangleCCD : SafeCCDWrapper::EdgeEdgeCCD;
  const bool collides =
      test(q.start(0), q.end(0), q.start(1), q.end(1), q.start(2), q.end(2), q.start(3), q.end(3), t, &r, &s);
  return Answer::of(collides, t);
}

/// 41 B ε^¼ with ε^¼ = 2^-13: the paper's claim, and half of `gap` in the code, which says of it that it is twice the largest
/// distance of a false positive.
double distance_bound(void* /*state*/, int /*kind*/, const double* x) {
  const Question q{x, 0};
  return 41 * 0x1p-13 *
         Wrapper::computeB(q.start(0), q.end(0), q.start(1), q.end(1), q.start(2), q.end(2), q.start(3),
                           q.end(3));
}

nearmiss_subject subject() {
  nearmiss_subject subject{};
  subject.interface_version = NEARMISS_INTERFACE;
  subject.name = "safeccd";
  subject.version = "1.0";
  subject.about = "the 2014 paper's own code, SAFE_CCD, with each pair's own bound B";
  subject.kinds = NEARMISS_VERTEX_TRIANGLE + NEARMISS_EDGE_EDGE;
  subject.time_sort = NEARMISS_TIME_ESTIMATE;
  subject.decide = decide_each<decide>;
  subject.distance_bound = distance_bound;
  return subject;
}

}  // namespace
}  // namespace nearmiss::peers

const nearmiss_subject* nearmiss_get_subject(std::size_t index) {
  static const nearmiss_subject subject = nearmiss::peers::subject();
  return index == 0 ? &subject : nullptr;
}
