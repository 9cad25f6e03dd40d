// What mutations and crossings make of a query's separation, and queries with a separation as inputs of libFuzzer.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>

#include "fuzz/families/families.hpp"
#include "fuzz/families/mutation.hpp"
#include "fuzz/libfuzzer/query_bytes.hpp"

namespace nearmiss {
namespace {

Query some_query(double separation) {
  return with_separation(make_query(find_family("uniform"), 8, 0), separation);
}

TEST(MutatedSeparation, AppearsInNoQueryThatAsksForContact) {
  for (std::uint64_t i = 0; i < 1000; ++i) {
    Random random(9, 0, i);
    EXPECT_EQ(mutated(random, some_query(0)).separation, 0) << i;
  }
}

TEST(MutatedSeparation, ChangesNowAndThen) {
  constexpr double before = 0x1.8p-3;
  int same = 0;
  int slightly = 0;
  int to_a_power_of_two = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    Random random(9, 0, i);
    const double after = mutated(random, some_query(before)).separation;
    int exponent = 0;
    same += after == before ? 1 : 0;
    slightly += after != before && std::abs(after - before) < 1e-3 ? 1 : 0;
    to_a_power_of_two += std::frexp(after, &exponent) == 0.5 ? 1 : 0;
  }
  EXPECT_GT(same, 600);
  EXPECT_GT(slightly, 30);
  EXPECT_GT(to_a_power_of_two, 30);
}

TEST(MutatedSeparation, IsADistanceAfterManyMutations) {
  for (const double first :
       {std::numeric_limits<double>::denorm_min(), 1.0, std::numeric_limits<double>::max()}) {
    Query query = some_query(first);
    for (std::uint64_t i = 0; i < 1000; ++i) {
      Random random(9, 0, i);
      query = mutated(random, query);
      ASSERT_TRUE(std::isfinite(query.separation) && query.separation >= 0) << first << ", " << i;
    }
  }
}

TEST(MutatedSeparation, IsScaledWithTheCoordinates) {
  const Query before = some_query(0.375);
  for (const Mutation& kind : mutations()) {
    if (kind.name != "scale") continue;
    Random random(9, 0, 0);
    const Query after = kind.apply(random, before);
    EXPECT_NE(after.x, before.x);
    EXPECT_EQ(after.separation / before.separation, after.x[0] / before.x[0]);
  }
}

TEST(CrossedSeparation, IsThatOfOneOfTheTwo) {
  std::set<double> seen;
  for (std::uint64_t i = 0; i < 100; ++i) {
    Random random(9, 0, i);
    seen.insert(crossed(random, some_query(0.25), some_query(0)).separation);
  }
  EXPECT_EQ(seen, (std::set{0.0, 0.25}));
}

using Bytes = std::array<std::uint8_t, libfuzzer::query_bytes>;

TEST(QueryBytes, AreReadBack) {
  for (const double separation : {0.0, 0.1, std::numeric_limits<double>::denorm_min()}) {
    for (const Kind kind : kinds) {
      Query query = some_query(separation);
      query.kind = kind;
      Bytes bytes{};
      const std::size_t size = libfuzzer::to_bytes(query, bytes.data());
      EXPECT_EQ(size, separation == 0 ? libfuzzer::contact_bytes : libfuzzer::query_bytes);
      EXPECT_EQ(libfuzzer::from_bytes(bytes.data(), size), query);
    }
  }
}

TEST(QueryBytes, AreRefusedIfTheyAreNoQuery) {
  Bytes bytes{};
  for (const std::size_t size : {std::size_t{0}, libfuzzer::contact_bytes - 1, libfuzzer::contact_bytes + 1})
    EXPECT_FALSE(libfuzzer::from_bytes(bytes.data(), size)) << size;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double separation : {-1.0, infinity, std::numeric_limits<double>::quiet_NaN()}) {
    libfuzzer::to_bytes(some_query(separation), bytes.data());
    EXPECT_FALSE(libfuzzer::from_bytes(bytes.data(), bytes.size())) << separation;
  }
  Query query = some_query(0.5);
  query.x[23] = infinity;
  libfuzzer::to_bytes(query, bytes.data());
  EXPECT_FALSE(libfuzzer::from_bytes(bytes.data(), bytes.size()));
}

}  // namespace
}  // namespace nearmiss
