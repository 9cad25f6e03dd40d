// What a campaign knows about the farthest false positives, and the samples of its queries.
#include "fuzz/trial/least_kept.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>

#include "fuzz/trial/sample.hpp"

namespace nearmiss {
namespace {

const CountsKey key{"subject", Kind::edge_edge, "family"};

/// Counters of false positives at the distances first, first + 1, ...
std::map<CountsKey, Counts> counters(double first, std::size_t cases) {
  Counts counts;
  for (std::size_t i = 0; i < cases; ++i)
    add_up(counts.farthest, {{.ratio = first + static_cast<double>(i), .query = {}, .provenance = ""}});
  return {{key, counts}};
}

TEST(LeastKept, IsZeroUntilAllPlacesAreTaken) {
  LeastKept least;
  EXPECT_EQ(least.of(key), 0);
  least.take(counters(1, Counts::far_cases - 1));
  EXPECT_EQ(least.of(key), 0);
  least.take(counters(1000, 1));
  EXPECT_EQ(least.of(key), 1);
}

TEST(LeastKept, IsThatOfTheFarthestOfAllCounters) {
  LeastKept least;
  least.take(counters(1, Counts::far_cases));
  least.take(counters(1000, Counts::far_cases - 1));
  EXPECT_EQ(least.of(key), Counts::far_cases) << "one of the first counters is still kept";
  least.take(counters(1, Counts::far_cases));
  EXPECT_EQ(least.of(key), Counts::far_cases);
  CountsKey other = key;
  other.kind = Kind::vertex_triangle;
  EXPECT_EQ(least.of(other), 0);
}

TEST(Sample, HasTheExpectedPartOfAnyProgression) {
  constexpr std::uint64_t numbers = 100'000;
  for (const std::uint64_t step : {1U, 2U, 256U, 1U << 24})
    for (const std::uint64_t one_in : {1U, 2U, 16U, 256U}) {
      std::uint64_t sampled = 0;
      for (std::uint64_t i = 0; i < numbers; ++i) sampled += is_sampled(7 + step * i, one_in) ? 1 : 0;
      const double expected = static_cast<double>(numbers) / static_cast<double>(one_in);
      EXPECT_NEAR(static_cast<double>(sampled), expected, 5 * std::sqrt(expected)) << step << ' ' << one_in;
    }
}

}  // namespace
}  // namespace nearmiss
