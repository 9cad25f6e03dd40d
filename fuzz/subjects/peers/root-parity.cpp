// Root parity (Brochu, Edwards, Bridson, "Efficient geometrically exact continuous collision detection",
// 2012).
// Source: github.com/bohanwang/libpgo, third-party/CCD/ExactCCD, 88dfe845. Licence: public domain.
// Question: whether the number of contacts is odd, counted with multiplicity: a double root counts twice.
// Contract: F, the volume of the four vertices, has at most one root, and this root is simple. Then the
// answer says whether there is contact.
// $ROOT_PARITY is the folder ExactCCD, with its code compiled into librootparity.a. The interval arithmetic
// rounds upwards, which the compiler must know: g++ needs -frounding-math.
//
//   tools/subject fuzz/subjects/peers/root-parity.cpp -- -I$ROOT_PARITY $ROOT_PARITY/librootparity.a
#include <exactCCDWrapper.h>

#include <cstdlib>

#include "ccd/nearmiss_functions.hpp"

namespace {

using nearmiss::plugin::Answer;
using nearmiss::plugin::Question;

/// Restarts rand() from the same seed for every query. The code replaces unlucky rays by random rays, but an
/// answer must depend only on the query. To be fast, uses the smallest state that the C library offers.
void restart_random_numbers() {
  static std::array<char, 8> smallest;
  static const bool is_set = initstate(1, smallest.data(), smallest.size()) != nullptr;
  if (is_set) std::srand(1);
}

Answer decide(const Question& q) {
  restart_random_numbers();
  const auto test =
      q.kind == NEARMISS_VERTEX_TRIANGLE ? ExactCCDWrapper::VertexTriangleCCD : ExactCCDWrapper::EdgeEdgeCCD;
  return Answer::of(
      test(q.start(0), q.end(0), q.start(1), q.end(1), q.start(2), q.end(2), q.start(3), q.end(3)));
}

}  // namespace

NEARMISS_SUBJECT(detector("root-parity", "2012",
                          "root parity, with intervals and expansions: whether the number of contacts is odd")
                     .vertex_triangle(decide)
                     .edge_edge(decide)
                     .set(&nearmiss_contract::one_root, 1))
