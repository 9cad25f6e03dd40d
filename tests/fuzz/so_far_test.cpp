// Tests what trials know from the cases counted so far, and which queries they sample.
#include "fuzz/trial/so_far.hpp"

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

TEST(SoFar, KeepsTheFarthestOfAllCounters) {
  SoFar so_far;
  so_far.take(counters(1, Counts::far_cases - 1));
  EXPECT_EQ(so_far.of(key).least_kept, 0) << "not all places are taken";
  so_far.take(counters(Counts::far_cases, 1));
  EXPECT_EQ(so_far.of(key).least_kept, 1);
  so_far.take(counters(1000, Counts::far_cases - 1));
  so_far.take(counters(1, Counts::far_cases));
  EXPECT_EQ(so_far.of(key).least_kept, Counts::far_cases) << "one of the first counters is still kept";
  EXPECT_EQ(so_far.of({"subject", Kind::vertex_triangle, "family"}).least_kept, 0);
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
