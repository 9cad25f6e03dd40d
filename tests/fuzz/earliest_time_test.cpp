// The time t* of the first contact or approach: its certified enclosure, and comparisons of t* with other
// times.
#include "oracle/earliest_time.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "fuzz/families/families.hpp"
#include "oracle/agreement/checked.hpp"
#include "oracle/oracle.hpp"
#include "tests/exact_times.hpp"
#include "tests/queries.hpp"
#include "tests/root_count.hpp"

namespace nearmiss {
namespace {

double above(double x) { return std::nextafter(x, 2); }
double below(double x) { return std::nextafter(x, 0); }

/// Times to compare with t*, the earliest time. Some of these times are hard to compare with t*: the ends of
/// `known` and `narrow`, which enclose t*, and the doubles next to these ends.
std::vector<double> times_around(const Enclosure& known, const Enclosure& narrow) {
  std::vector<double> times{0, 1, 0.5};
  for (const double end : {known.lo, known.hi, narrow.lo, narrow.hi})
    for (const double time : {below(end), end, above(end), end / 2, (1 + end) / 2}) times.push_back(time);
  return times;
}

TEST(EarliestTime, IsComparedAsInExactArithmetic) {
  for (const Family& family : all_families())
    for (std::uint64_t i = 0; i < (family.block_cases < 25 ? 10 : 100); ++i) {
      SCOPED_TRACE(family.name + ":1:" + std::to_string(i));
      const Query query = make_query(family, 1, i);
      auto time = earliest_time(query);
      if (!time) continue;
      const Enclosure known = time->known();
      const Enclosure narrow = earliest_time(query)->enclosure();
      EXPECT_LE(known.lo, narrow.lo);
      EXPECT_LE(narrow.hi, known.hi);
      EXPECT_LE(narrow.hi, above(narrow.lo));
      auto exactly = testing::exact_times(query);
      ASSERT_TRUE(exactly);
      for (const double at : times_around(known, narrow)) {
        const bool is_late = exactly->below && testing::is_before(*exactly->below, at);
        EXPECT_EQ(time->is_before(at), testing::is_before(exactly->time, at)) << at;
        EXPECT_EQ(time->makes_late(at), is_late) << at;
      }
    }
}

/// A vertex that falls, and meets a triangle at t = 3/8.
Query falling() { return testing::falling_vertex(0.25, 0.25, 3, -5); }

TEST(EarliestTime, IsNotBeforeItself) {
  auto time = *earliest_time(falling());
  EXPECT_FALSE(time.is_before(0.375));
  EXPECT_TRUE(time.is_before(above(0.375)));
  EXPECT_FALSE(time.is_before(std::nan("")));
  EXPECT_TRUE(time.is_before(HUGE_VAL));
  EXPECT_FALSE(time.is_before(-1));
  EXPECT_EQ(time.enclosure(), (Enclosure{0.375, 0.375}));
  EXPECT_EQ(time.rational(), "3/8");
}

TEST(EarliestTime, IsKnownWithoutExactArithmetic) {
  const auto time = *earliest_time(falling());
  EXPECT_LE(time.known().lo, 0.375);
  EXPECT_GE(time.known().hi, 0.375);
  EXPECT_LT(time.known().hi - time.known().lo, 1e-12);
}

// In many queries of this test, the primitives touch twice, at nearly the same time.
TEST(EarliestTime, IsOfTheFirstOfTwoContacts) {
  std::size_t later = 0;
  for (std::uint64_t i = 0; i < 600; ++i) {
    const Query query = make_query(find_family("even-roots"), 1, i);
    auto time = earliest_time(query);
    if (!time || !(time->known().hi < 1)) continue;
    later += testing::count_roots(query).distinct > 1 ? 1 : 0;
    EXPECT_EQ(time_disagreement(query, decide(query)), "") << i;
  }
  EXPECT_GT(later, 30);
}

}  // namespace
}  // namespace nearmiss
