// Families of exact contact keep their promises: they make contacts at the ends of the step, at times that
// are hard to find, and at double and triple roots.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "fuzz/families/contacts.hpp"
#include "oracle/features.hpp"
#include "oracle/oracle.hpp"
#include "tests/fuzz/family_queries.hpp"
#include "tests/root_count.hpp"

namespace nearmiss {
namespace {

using testing::at;
using testing::at_rest;
using testing::count_of_400;
using testing::expect_all;
using testing::expect_count;
using testing::expect_more;
using testing::first_queries;
using testing::first_time;
using testing::reversed;
using testing::roots_before;

/// The time of the last contact. It must be a multiple of 2^-52, so that the difference from 1 is exact.
double last_time(const Query& query) { return 1 - first_time(reversed(query)); }

bool is_sixteenths(double time) { return 16 * time == std::floor(16 * time); }

bool touches_at_the_start(const Query& query) { return collides_exactly(at_rest(query, 0)); }
bool touches_at_the_end(const Query& query) { return collides_exactly(at_rest(query, 1)); }

TEST(FarFamilies, TouchAtAnEndOfTheStepAtEveryScale) {
  for (const char* x : {"@-6", "@0", "@6"}) {
    expect_all(std::string("far-end") + x, touches_at_the_end);
    expect_all(std::string("far-start") + x, touches_at_the_start);
  }
}

TEST(EndContact, IsExactlyAtAnEndOfTheStep) {
  expect_more("end-contact@0", 140, touches_at_the_start);
  expect_more("end-contact@0", 140, touches_at_the_end);
  expect_all("end-contact@0",
             [](const Query& query) { return touches_at_the_start(query) || touches_at_the_end(query); });
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

TEST(OnePoint, HalfOfTheQueriesTouch) {
  const auto is_one = [](const Query& query) { return query.start(0) == query.start(3); };
  expect_count("one-point", 150, 250, is_one);
  EXPECT_EQ(count_of_400("one-point", collides_exactly), count_of_400("one-point", is_one));
}

TEST(TouchTwice, MostTouchAtTwoTimes) {
  expect_more("touch-twice", 300, [](const Query& query) {
    const double first = earliest_time(query)->enclosure().hi;
    const double last = 1 - earliest_time(reversed(query))->enclosure().hi;
    return last - first >= 1.0 / 16;
  });
}

// In one query of four, the primitives turn back before they touch; in some queries, the points that meet are
// outside the primitives.
TEST(EvenRoots, ThePrimitivesMeetTwiceHoweverNearTheTimes) {
  for (const char* family : {"even-roots@-16", "even-roots@-2"})
    expect_more(family, 40, [](const Query& query) { return testing::count_roots(query).distinct == 2; });
}

// The family makes one query in eight with a triple root. The root stays exact if no number of the query is
// rounded.
TEST(TripleRoot, ThePrimitivesMeetInATripleRoot) {
  expect_more("triple-root@-16", 5, [](const Query& query) {
    const testing::RootCount roots = testing::count_roots(query);
    return roots.distinct == 1 && roots.with_multiplicity == 3;
  });
}

TEST(CloseRoots, TheFirstContactIsExactlyAtARoot) {
  for (const int x : {-40, -4})
    for (const Query& query : first_queries(at("close-roots", x), 100)) {
      const double time = first_time(query);
      EXPECT_EQ(roots_before(query, std::nextafter(time, 2)), roots_before(query, time) + 1);
    }
}

TEST(TouchOnce, HalfTouchExactlyAtOneTime) {
  for (const int x : {-40, -12})
    expect_count(at("touch-once", x), 160, 240, [](const Query& query) {
      if (!collides_exactly(query)) return false;
      const auto [lo, hi] = earliest_time(query)->enclosure();
      return lo > 0 && lo == hi && is_sixteenths(lo) &&
             earliest_time(reversed(query))->enclosure() == Enclosure{1 - lo, 1 - lo};
    });
}

TEST(BorderFirst, ThePrimitivesMeetAtTwoTimesAndInsideAtTheSecond) {
  for (const int x : {-40, -5})
    for (const Query& query : first_queries(at("border-first", x), 200)) {
      const double first = first_time(query);
      EXPECT_TRUE(is_sixteenths(first));
      EXPECT_GE(last_time(query), first + 1.0 / 16);
      EXPECT_EQ(contact_features(reversed(query))->location, ContactFeatures::Location::interior);
    }
}

TEST(ReturnLater, TheFirstContactIsAtTheStartOrAsSoonAsTheParameterSays) {
  for (const auto& [x, soon] : {std::pair(-49, "1/562949953421313"), {-10, "1/1025"}})
    expect_count(at("return-later", x), 160, 240, [soon = soon](const Query& query) {
      const std::string time = earliest_time(query)->rational();
      EXPECT_TRUE(time == "0" || time == soon) << time;
      EXPECT_GE(last_time(query), 0.25);
      return time == "0";
    });
}

TEST(SlowContact, IsExactlyAtAMultipleOfASixteenth) {
  for (const int x : {-40, -10})
    for (const Query& query : first_queries(at("slow-contact", x), 200)) {
      const double time = first_time(query);
      EXPECT_TRUE(is_sixteenths(time) && 0 < time && time < 1) << time;
    }
}

}  // namespace
}  // namespace nearmiss
