// The families of contacts at the ends of the step, without motion and at two times keep their promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "fuzz/families/contacts.hpp"
#include "oracle/oracle.hpp"
#include "tests/fuzz/family_queries.hpp"

namespace nearmiss {
namespace {

using testing::at_rest;
using testing::count_of_400;
using testing::longest_edge;
using testing::reversed;

/// Whether the difference of start and end needs more bits than a double has, for some coordinate.
bool motion_is_rounded(const Query& query) {
  for (std::size_t i = 0; i < 12; ++i) {
    const double motion = query.x[12 + i] - query.x[i];
    if (query.x[i] + motion != query.x[12 + i]) return true;
  }
  return false;
}

TEST(FarEnd, TouchesAtTheEndAtEveryScale) {
  for (const char* family : {"far-end@-6", "far-end@0", "far-end@6", "far-end"})
    EXPECT_EQ(count_of_400(family, [](const Query& query) { return collides_exactly(at_rest(query, 1)); }),
              400)
        << family;
}

TEST(FarStart, TouchesAtTheStartAtEveryScale) {
  for (const char* family : {"far-start@-6", "far-start@0", "far-start@6", "far-start"})
    EXPECT_EQ(count_of_400(family, [](const Query& query) { return collides_exactly(at_rest(query, 0)); }),
              400)
        << family;
}

TEST(FarEnd, TheParameterIsTheSize) {
  for (const int x : {-6, 0, 3})
    EXPECT_GT(count_of_400("far-end@" + std::to_string(x),
                           [&](const Query& query) {
                             const double size = longest_edge(query, 1) / power_of_ten(x);
                             return 0.25 < size && size < 8;
                           }),
              390)
        << x;
}

TEST(FarEnd, TheMotionIsLongAndHasMoreBitsThanADouble) {
  EXPECT_GT(
      count_of_400("far-end", [](const Query& query) { return extent(query) > 30 * longest_edge(query, 1); }),
      100);
  EXPECT_GT(count_of_400("far-end", motion_is_rounded), 150);
}

TEST(FirstMoment, MostFirstTouchBefore2ToTheMinus49ButNotAtTheStart) {
  for (const char* family : {"first-moment@-50", "first-moment@-110"}) {
    EXPECT_EQ(count_of_400(family, collides_exactly), 400) << family;
    EXPECT_GT(count_of_400(family,
                           [](const Query& query) {
                             const double time = earliest_time(query)->enclosure().hi;
                             return 0 < time && time < 0x1p-49 && !collides_exactly(at_rest(query, 0));
                           }),
              300)
        << family;
  }
}

TEST(FirstMoment, AboutOneInAHundredTouchesAtTheStart) {
  const std::vector<Query> queries = testing::first_queries("first-moment", 4000);
  const auto touching = std::count_if(queries.begin(), queries.end(),
                                      [](const Query& query) { return collides_exactly(at_rest(query, 0)); });
  EXPECT_GT(touching, 20);
  EXPECT_LT(touching, 60);
}

TEST(OnePoint, PrimitivesArePointsAtRestAndHalfOfThemAreOne) {
  const auto is_at_rest = [](const Query& query) { return at_rest(query, 0) == query; };
  EXPECT_EQ(count_of_400("one-point", is_at_rest), 400);
  EXPECT_EQ(count_of_400("one-point", [](const Query& query) { return longest_edge(query, 0) == 0; }), 400);
  const int one =
      count_of_400("one-point", [](const Query& query) { return query.start(0) == query.start(3); });
  EXPECT_EQ(count_of_400("one-point", collides_exactly), one);
  EXPECT_GT(one, 150);
  EXPECT_LT(one, 250);
}

TEST(TouchTwice, MostTouchAtTwoTimes) {
  EXPECT_EQ(count_of_400("touch-twice", collides_exactly), 400);
  EXPECT_GT(count_of_400("touch-twice",
                         [](const Query& query) {
                           const double first = earliest_time(query)->enclosure().hi;
                           const double last = 1 - earliest_time(reversed(query))->enclosure().hi;
                           return last - first >= 1.0 / 16;
                         }),
            300);
}

}  // namespace
}  // namespace nearmiss
