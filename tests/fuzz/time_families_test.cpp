// The families of contacts at times that are hard to find keep their promises, exactly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "fuzz/families/contacts.hpp"
#include "oracle/distance.hpp"
#include "oracle/exact/predicates.hpp"
#include "oracle/features.hpp"
#include "oracle/oracle.hpp"
#include "tests/fuzz/family_queries.hpp"
#include "tests/root_count.hpp"

namespace nearmiss {
namespace {

using testing::at;
using testing::at_rest;
using testing::expect_all;
using testing::expect_count;
using testing::expect_more;
using testing::first_queries;
using testing::first_time;
using testing::reversed;
using testing::roots_before;

/// The time of the last contact, for times that are multiples of 2^-52.
double last_time(const Query& query) { return 1 - first_time(reversed(query)); }

bool is_sixteenths(double time) { return 16 * time == std::floor(16 * time); }

/// The first root of F, which is a multiple of 1/16.
double first_root(const Query& query) {
  int sixteenths = 0;
  while (roots_before(query, (sixteenths + 1) / 16.0) == 0) ++sixteenths;
  return sixteenths / 16.0;
}

TEST(CloseRoots, AllRootsAreInTheStepAndAsCloseAsTheParameterSays) {
  for (const int x : {-40, -20, -4})
    for (const Query& query : first_queries(at("close-roots", x), 200)) {
      const double first = first_root(query);
      const double gap = std::ldexp(1.0, x);
      const int roots = roots_before(query, 2);
      EXPECT_TRUE(roots == 2 || roots == 3) << roots;
      EXPECT_EQ(roots_before(query, first + gap), 1);
      EXPECT_GE(roots_before(query, first + 4 * gap), 2);
      EXPECT_EQ(roots_before(query, first + 7 * gap), roots);
    }
}

TEST(CloseRoots, TheFirstContactIsExactlyAtARoot) {
  for (const int x : {-40, -20, -4})
    for (const Query& query : first_queries(at("close-roots", x), 200)) {
      const double time = first_time(query);
      EXPECT_EQ(roots_before(query, std::nextafter(time, 2)), roots_before(query, time) + 1);
    }
}

TEST(CloseRoots, ContactIsAtAnyOfTheRoots) {
  for (const int earlier : {0, 1, 2})
    expect_more("close-roots", 30,
                [&](const Query& query) { return roots_before(query, first_time(query)) == earlier; });
  for (const int contacts : {1, 2, 3})
    expect_more("close-roots", 30,
                [&](const Query& query) { return testing::count_roots(query).distinct == contacts; });
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

TEST(TouchOnce, ManyTouchInADoubleRootAndManyInAPlane) {
  expect_more("touch-once", 90, [](const Query& query) {
    const testing::RootCount roots = testing::count_roots(query);
    return roots.distinct == 1 && roots.with_multiplicity == 2;
  });
  expect_more("touch-once", 90, [](const Query& query) { return testing::count_roots(query).planar; });
}

TEST(TouchOnce, AQuarterPassesAtATinyDistance) {
  for (const int x : {-40, -12})
    expect_count(at("touch-once", x), 70, 140, [x](const Query& query) {
      if (collides_exactly(query)) return false;
      EXPECT_LT(minimum_distance(query).hi, std::ldexp(extent(query), x + 1));
      return true;
    });
}

TEST(TouchOnce, AQuarterMeetsFor2ToThe20) {
  expect_count("touch-once@-40", 70, 140, [](const Query& query) {
    if (!collides_exactly(query)) return false;
    const double between =
        1 - earliest_time(reversed(query))->enclosure().lo - earliest_time(query)->enclosure().lo;
    return 0x1p-24 < between && between < 0x1p-17;
  });
}

TEST(BorderFirst, ThePrimitivesMeetAtTwoTimes) {
  for (const int x : {-40, -5})
    expect_all(at("border-first", x), [](const Query& query) {
      const double first = first_time(query);
      return testing::count_roots(query).distinct == 2 && is_sixteenths(first) &&
             last_time(query) >= first + 1.0 / 16;
    });
}

TEST(BorderFirst, TheSecondContactIsInsideAndTwoThirdsOfTheFirstAreNot) {
  const auto is_inside = [](const Query& query) {
    return contact_features(query)->location == ContactFeatures::Location::interior;
  };
  expect_all("border-first", [&](const Query& query) { return is_inside(reversed(query)); });
  expect_count("border-first", 100, 170, is_inside);
}

TEST(BorderFirst, TheSidesAreParallelAsNearTheFirstContactAsTheParameterSays) {
  for (const int x : {-40, -5})
    expect_all(at("border-first", x), [x](const Query& query) {
      exact::Predicates predicates(query);
      const auto is_parallel_at = [&](double time) {
        const auto vanishes = [&](const exact::Polynomial& each) { return each.sign_at(time) == 0; };
        return std::all_of(predicates.N().begin(), predicates.N().end(), vanishes);
      };
      const double first = first_time(query);
      const double off = std::ldexp(1.0, x);
      return is_parallel_at(first - off) != is_parallel_at(first + off);
    });
}

TEST(ReturnLater, TheFirstContactIsAtTheStartOrAsSoonAsTheParameterSays) {
  for (const auto& [x, soon] : {std::pair(-49, "1/562949953421313"), {-10, "1/1025"}})
    expect_count(at("return-later", x), 160, 240, [soon = soon](const Query& query) {
      const std::string time = earliest_time(query)->rational();
      EXPECT_TRUE(time == "0" || time == soon) << time;
      return time == "0";
    });
}

TEST(ReturnLater, ThereIsASecondContactInside) {
  for (const int x : {-49, -10})
    for (const Query& query : first_queries(at("return-later", x), 400)) {
      EXPECT_EQ(testing::count_roots(query).distinct, 2);
      EXPECT_GE(last_time(query), 0.25);
      EXPECT_EQ(contact_features(reversed(query))->location, ContactFeatures::Location::interior);
    }
}

TEST(SlowContact, IsExactlyAtAMultipleOfASixteenth) {
  for (const int x : {-40, -10})
    for (const Query& query : first_queries(at("slow-contact", x), 400)) {
      const double time = first_time(query);
      EXPECT_TRUE(is_sixteenths(time) && 0 < time && time < 1) << time;
    }
}

TEST(SlowContact, ThePrimitivesStartAsNearAsTheParameterSays) {
  for (const int x : {-40, -10})
    for (const Query& query : first_queries(at("slow-contact", x), 400)) {
      const double distance = minimum_distance(at_rest(query, 0)).hi / std::ldexp(extent(query), x);
      EXPECT_LT(distance, 8);
      EXPECT_GT(distance, 1.0 / 1024);
    }
}

}  // namespace
}  // namespace nearmiss
