// The families of contacts at the ends of the step, without motion and at two times keep their promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "fuzz/families/contacts.hpp"
#include "oracle/oracle.hpp"
#include "tests/fuzz/family_queries.hpp"

namespace nearmiss {
namespace {

using testing::at_rest;
using testing::count_of_400;
using testing::expect_all;
using testing::expect_count;
using testing::expect_more;
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

bool touches_at_the_start(const Query& query) { return collides_exactly(at_rest(query, 0)); }
bool touches_at_the_end(const Query& query) { return collides_exactly(at_rest(query, 1)); }

TEST(FarEnd, TouchesAtTheEndAtEveryScale) {
  for (const char* family : {"far-end@-6", "far-end@0", "far-end@6", "far-end"})
    expect_all(family, touches_at_the_end);
}

TEST(FarStart, TouchesAtTheStartAtEveryScale) {
  for (const char* family : {"far-start@-6", "far-start@0", "far-start@6", "far-start"})
    expect_all(family, touches_at_the_start);
}

TEST(FarEnd, TheParameterIsTheSize) {
  for (const int x : {-6, 0, 3})
    expect_more(testing::at("far-end", x), 390, [x](const Query& query) {
      const double size = longest_edge(query, 1) / power_of_ten(x);
      return 0.25 < size && size < 8;
    });
}

TEST(FarEnd, TheMotionIsLongAndHasMoreBitsThanADouble) {
  expect_more("far-end", 100, [](const Query& query) { return extent(query) > 30 * longest_edge(query, 1); });
  expect_more("far-end", 150, motion_is_rounded);
}

TEST(FirstMoment, MostFirstTouchBefore2ToTheMinus49ButNotAtTheStart) {
  for (const char* family : {"first-moment@-50", "first-moment@-110"}) {
    expect_all(family, collides_exactly);
    expect_more(family, 300, [](const Query& query) {
      const double time = earliest_time(query)->enclosure().hi;
      return 0 < time && time < 0x1p-49 && !touches_at_the_start(query);
    });
  }
}

TEST(FirstMoment, AboutOneInAHundredTouchesAtTheStart) {
  const std::vector<Query> queries = testing::first_queries("first-moment", 4000);
  const auto touching = std::count_if(queries.begin(), queries.end(), touches_at_the_start);
  EXPECT_GT(touching, 20);
  EXPECT_LT(touching, 60);
}

TEST(OnePoint, PrimitivesArePointsAtRestAndHalfOfThemAreOne) {
  expect_all("one-point", [](const Query& query) { return at_rest(query, 0) == query; });
  expect_all("one-point", [](const Query& query) { return longest_edge(query, 0) == 0; });
  const auto is_one = [](const Query& query) { return query.start(0) == query.start(3); };
  expect_count("one-point", 150, 250, is_one);
  EXPECT_EQ(count_of_400("one-point", collides_exactly), count_of_400("one-point", is_one));
}

TEST(TouchTwice, MostTouchAtTwoTimes) {
  expect_all("touch-twice", collides_exactly);
  expect_more("touch-twice", 300, [](const Query& query) {
    const double first = earliest_time(query)->enclosure().hi;
    const double last = 1 - earliest_time(reversed(query))->enclosure().hi;
    return last - first >= 1.0 / 16;
  });
}

}  // namespace
}  // namespace nearmiss
