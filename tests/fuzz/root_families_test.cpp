// The families whose roots of F are hard to find keep their promises.
#include <gtest/gtest.h>

#include <cmath>

#include "oracle/oracle.hpp"
#include "oracle/sturm.hpp"
#include "tests/fuzz/family_queries.hpp"

namespace nearmiss {
namespace {

using testing::count_of_400;

TEST(EndContact, IsExactBeforeItIsMoved) { EXPECT_EQ(count_of_400("end-contact@0", collides_exactly), 400); }

TEST(EvenRoots, ThereAreTwoHoweverNear) {
  for (const char* family : {"even-roots@-16", "even-roots@-8", "even-roots@-2"})
    EXPECT_GT(count_of_400(family, [](const Query& query) { return count_roots(query).distinct == 2; }), 40)
        << family;
  const auto is_double = [](const Query& query) {
    const RootCount roots = count_roots(query);
    return roots.distinct == 1 && roots.with_multiplicity == 2;
  };
  EXPECT_GT(count_of_400("even-roots@-2", is_double), 4);  // one in eight, where the primitives are exact
}

TEST(TripleRoot, IsExactHereAndThere) {
  const auto is_triple = [](const Query& query) {
    const RootCount roots = count_roots(query);
    return roots.distinct == 1 && roots.with_multiplicity == 3;
  };
  for (const char* family : {"triple-root@-16", "triple-root@0"})
    EXPECT_GT(count_of_400(family, is_triple), 4) << family;
}

}  // namespace
}  // namespace nearmiss
