// Tests the search for the smallest distance on queries of several families.
#include "oracle/distance/approach.hpp"

#include <gtest/gtest.h>

#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"
#include "tests/fuzz/family_queries.hpp"

namespace nearmiss::certified {
namespace {

using testing::first_queries;

constexpr std::uint64_t seed = 20;

TEST(ClosestApproach, ResolvesEveryFamilyWithoutExactArithmetic) {
  int apart = 0;
  for (const char* family :
       {"planted-ulp", "grazing", "parallel", "sliver", "stiff", "aspect", "offset", "scale",
        "near-parallel-edges", "needle", "static-pair", "rigid", "end-contact", "even-roots", "triple-root"})
    for (const Query& query : first_queries(family, 200, seed)) {
      if (collides(query)) continue;
      ++apart;
      // If the smallest distance is below 2^-300, the lower end of its enclosure may be 0.
      const Approach approach = closest_approach(
          VertexDifferences(query), [](double upper) { return upper < 0x1p-300 ? 0 : 0.999 * upper; });
      EXPECT_TRUE(approach.enough) << family;
    }
  EXPECT_GT(apart, 1000);
}

TEST(ClosestApproach, DoesNotTellACollisionFromContact) {
  for (const Query& query : first_queries("planted", 100, seed)) {
    const Approach approach =
        closest_approach(VertexDifferences(query), [](double upper) { return 0.5 * upper; });
    EXPECT_FALSE(approach.enough);
    EXPECT_EQ(approach.lower, 0);
    EXPECT_LT(approach.upper, 0x1p-40);
  }
}

/// In double, interval arithmetic has given a distance for this query that was far above the smallest one:
/// 4.85e-08 times the bound of a CCD.
TEST(DistanceInUnits, ASliversDistanceIsKnown) {
  const Query query = make_query(find_family("sliver"), 77, 454);
  const Enclosure distance = minimum_distance(query);
  EXPECT_LE(distance.lo, 0x1.7ap-59);
  EXPECT_GE(distance.hi, 0x1.79c4p-59);
  EXPECT_LE(distance.hi - distance.lo, 1e-3 * distance.hi);
}

}  // namespace
}  // namespace nearmiss::certified
