// Root parity (Brochu, Edwards, Bridson, "Efficient geometrically exact continuous collision detection",
// 2012).
#include <exactCCDWrapper.h>

#include <cstdlib>

#include "fuzz/subjects/peers/adapter.hpp"

namespace nearmiss::peers {
namespace {

/// An answer must depend only on the query, but the rays that replace an unlucky one come from rand().
/// Therefore every query starts from the same seed. The smallest state that the C library offers makes that
/// cheap.
void restart_random_numbers() {
  static std::array<char, 8> smallest;
  static const bool is_set = initstate(1, smallest.data(), smallest.size()) != nullptr;
  if (is_set) std::srand(1);
}

Answer decide(const void* /*state*/, int kind, const Question& q) {
  restart_random_numbers();
  const auto test =
      kind == NEARMISS_VERTEX_TRIANGLE ? ExactCCDWrapper::VertexTriangleCCD : ExactCCDWrapper::EdgeEdgeCCD;
  return Answer::of(
      test(q.start(0), q.end(0), q.start(1), q.end(1), q.start(2), q.end(2), q.start(3), q.end(3)));
}

nearmiss_subject subject() {
  nearmiss_subject subject =
      detector<decide>("root-parity", "2012",
                       "root parity, with intervals and expansions: whether the number of contacts is odd");
  // It answers whether the number of contacts is odd, counted with multiplicity: a double root counts twice.
  // This agrees with our question if there is at most one contact, at a simple root.
  subject.contract.one_root = 1;
  return subject;
}

}  // namespace
}  // namespace nearmiss::peers

const nearmiss_subject* nearmiss_get_subject(std::size_t index) {
  return nearmiss::peers::numbered<nearmiss::peers::subject>(index);
}
