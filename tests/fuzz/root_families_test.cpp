// The families whose roots of F are hard to find keep their promises.
#include <gtest/gtest.h>

#include <iostream>

#include "fuzz/families/contacts.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"
#include "tests/fuzz/family_queries.hpp"
#include "tests/root_count.hpp"

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

/// Expects that more than `above` of 200 queries of each kind have a property.
template <class Property>
void expect_more_of_each_kind(std::string_view family, int above, const Property& has_property) {
  for (const Kind kind : kinds_of_meshes)
    EXPECT_GT(count_of_200(family, kind, has_property), above) << family << ' ' << short_name(kind);
}

/// Whether F has one root, of this multiplicity.
auto has_one_root(int multiplicity) {
  return [=](const Query& query) {
    const testing::RootCount roots = testing::count_roots(query);
    return roots.distinct == 1 && roots.with_multiplicity == multiplicity;
  };
}

TEST(EndContact, IsExactlyAtAnEndOfTheStep) {
  const auto touches_at = [](int time) {
    return [=](const Query& query) { return collides_exactly(at_rest(query, time)); };
  };
  for (const int time : {0, 1}) expect_more_of_each_kind("end-contact@0", 70, touches_at(time));
  testing::expect_all("end-contact@0",
                      [&](const Query& query) { return touches_at(0)(query) || touches_at(1)(query); });
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
  for (const char* family : {"even-roots@-16", "even-roots@-8", "even-roots@-2"})
    expect_more_of_each_kind(family, 15,
                             [](const Query& query) { return testing::count_roots(query).distinct == 2; });
}

TEST(EvenRoots, TheTimeBetweenTheContactsIsTheParameter) {
  for (const Kind kind : kinds_of_meshes) {
    int twice = 0;
    const int as_far = count_of_200("even-roots@-2", kind, [&](const Query& query) {
      if (testing::count_roots(query).distinct != 2) return false;
      ++twice;
      const double first = earliest_time(query)->enclosure().hi;
      const double last = 1 - earliest_time(reversed(query))->enclosure().hi;
      return 0.005 < last - first && last - first < 0.02;
    });
    std::cout << short_name(kind) << ": " << as_far << " of " << twice << "\n";
    EXPECT_GT(4 * as_far, 3 * twice) << short_name(kind);  // in the others, F has a third root
  }
}

TEST(EvenRoots, SomeAreDouble) { expect_more_of_each_kind("even-roots@-2", 2, has_one_root(2)); }

// One query in eight has an exact triple root, if its numbers are exact.
TEST(TripleRoot, ThePrimitivesMeetInATripleRoot) {
  for (const char* family : {"triple-root@-16", "triple-root@0"})
    expect_more_of_each_kind(family, 2, has_one_root(3));
}

TEST(TripleRoot, ThePrimitivesNearlyMeetHoweverFarTheRootsAre) {
  expect_more_of_each_kind("triple-root@-16", 120, [](const Query& query) {
    return minimum_distance(query).hi <= 1e-12 * testing::largest_coordinate(query);
  });
}

}  // namespace
}  // namespace nearmiss
