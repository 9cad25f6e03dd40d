// The families whose roots of F are hard to find keep their promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "fuzz/families/contacts.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"
#include "oracle/sturm/sturm.hpp"
#include "tests/fuzz/family_queries.hpp"

namespace nearmiss {
namespace {

using testing::at_rest;
using testing::count_of_400;
using testing::reversed;

/// The number of queries, among 200 of a kind, that have a property.
template <class Property>
int count_of_200(std::string_view family, Kind kind, const Property& has_property) {
  return count_of_400(family, [&](const Query& query) { return query.kind == kind && has_property(query); });
}

TEST(EndContact, IsExactlyAtAnEndOfTheStep) {
  for (const Kind kind : kinds)
    for (const int time : {0, 1})
      EXPECT_GT(count_of_200("end-contact@0", kind,
                             [&](const Query& query) { return collides_exactly(at_rest(query, time)); }),
                70)
          << short_name(kind) << ' ' << time;
  EXPECT_EQ(count_of_400("end-contact@0",
                         [](const Query& query) {
                           return collides_exactly(at_rest(query, 0)) || collides_exactly(at_rest(query, 1));
                         }),
            400);
}

TEST(EndContact, OneCoordinateIsMovedByTheParameter) {
  const Family exact = find_family("end-contact@0");
  const Family moved = find_family("end-contact@8");
  for (std::uint64_t index = 0; index < 400; ++index) {
    const Query before = make_query(exact, 5, index);
    const Query after = make_query(moved, 5, index);
    int changed = 0;
    for (std::size_t i = 0; i < 24; ++i) {
      if (before.x[i] == after.x[i]) continue;
      ++changed;
      EXPECT_TRUE(after.x[i] == moved_by_ulps(before.x[i], 8) || after.x[i] == moved_by_ulps(before.x[i], -8))
          << index;
    }
    EXPECT_EQ(changed, 1) << index;
  }
}

// One query in four turns back before contact. In some queries, contact is outside of the primitives.
TEST(EvenRoots, ThePrimitivesMeetTwiceHoweverNearTheTimes) {
  for (const Kind kind : kinds)
    for (const char* family : {"even-roots@-16", "even-roots@-8", "even-roots@-2"})
      EXPECT_GT(
          count_of_200(family, kind, [](const Query& query) { return count_roots(query).distinct == 2; }), 15)
          << family << ' ' << short_name(kind);
}

TEST(EvenRoots, TheTimeBetweenTheContactsIsTheParameter) {
  for (const Kind kind : kinds) {
    int twice = 0;
    const int as_far = count_of_200("even-roots@-2", kind, [&](const Query& query) {
      if (count_roots(query).distinct != 2) return false;
      ++twice;
      const double first = earliest_time(query)->enclosure().hi;
      const double last = 1 - earliest_time(reversed(query))->enclosure().hi;
      return 0.005 < last - first && last - first < 0.02;
    });
    std::cout << short_name(kind) << ": " << as_far << " of " << twice << "\n";
    EXPECT_GT(4 * as_far, 3 * twice) << short_name(kind);  // F has a third root
  }
}

TEST(EvenRoots, SomeAreDouble) {
  for (const Kind kind : kinds) {
    const auto is_double = [](const Query& query) {
      const RootCount roots = count_roots(query);
      return roots.distinct == 1 && roots.with_multiplicity == 2;
    };
    EXPECT_GT(count_of_200("even-roots@-2", kind, is_double), 2) << short_name(kind);
  }
}

// One query in eight has an exact triple root, if its numbers are exact.
TEST(TripleRoot, ThePrimitivesMeetInATripleRoot) {
  for (const Kind kind : kinds)
    for (const char* family : {"triple-root@-16", "triple-root@0"}) {
      const auto is_triple = [](const Query& query) {
        const RootCount roots = count_roots(query);
        return roots.distinct == 1 && roots.with_multiplicity == 3;
      };
      EXPECT_GT(count_of_200(family, kind, is_triple), 2) << family << ' ' << short_name(kind);
    }
}

TEST(TripleRoot, ThePrimitivesNearlyMeetHoweverFarTheRootsAre) {
  for (const Kind kind : kinds)
    EXPECT_GT(count_of_200("triple-root@-16", kind,
                           [](const Query& query) {
                             return minimum_distance(query).hi <= 1e-12 * testing::largest_coordinate(query);
                           }),
              120)
        << short_name(kind);
}

}  // namespace
}  // namespace nearmiss
