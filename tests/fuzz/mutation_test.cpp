// Mutations are pure functions, and give queries of finite numbers that often collide. Also tests the places
// at which mutations restore contact, and libFuzzer's inputs.
#include "fuzz/families/mutation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "fuzz/families/families.hpp"
#include "fuzz/families/place.hpp"
#include "fuzz/libfuzzer/query_bytes.hpp"
#include "oracle/oracle.hpp"
#include "tests/bit_hash.hpp"
#include "tests/fuzz/family_queries.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

TEST(Mutated, IsAnotherFiniteQueryHoweverLongTheChain) {
  for (std::uint64_t chain = 0; chain < 10'000; ++chain) {
    const Family& family = families()[chain % families().size()];
    const double h = std::array{0.0, std::numeric_limits<double>::denorm_min(), 0.375,
                                std::numeric_limits<double>::max()}[chain % 4];
    Query query = with_separation(make_query(family, 5, chain), h);
    for (std::uint64_t step = 0; step < 8; ++step) {
      Random random(6, chain, step);
      const Query next = mutated(random, query);
      ASSERT_TRUE(is_finite(next)) << chain << ", " << step;
      ASSERT_NE(next, query) << chain << ", " << step;
      ASSERT_TRUE(std::isfinite(next.separation) && next.separation >= 0) << chain << ", " << step;
      ASSERT_TRUE(h > 0 || next.separation == 0) << chain << ", " << step;
      query = next;
    }
  }
}

TEST(Mutated, KeepsToCollisions) {
  int collisions = 0;
  constexpr int chains = 200;
  constexpr int steps = 10;
  for (std::uint64_t chain = 0; chain < chains; ++chain) {
    Query query = make_query(find_family("uniform"), 7, chain);
    for (std::uint64_t step = 0; step < steps; ++step) {
      Random random(7, chain, step);
      query = mutated(random, query);
      collisions += collides(query) ? 1 : 0;
    }
  }
  EXPECT_GE(collisions, chains * steps / 2);
}

// The provenance of a finding by search or by libFuzzer names a seed. The same seed must always give the same
// query, so mutations must not change.
TEST(Mutated, IsWhatItAlwaysWas) {
  testing::BitHash hash;
  testing::BitHash of_separations;
  const auto queries = testing::first_queries("uniform", 1000);
  for (std::uint64_t i = 0; i < queries.size(); ++i) {
    Random random(2, 0, i);
    hash.add_all(mutated(random, queries[i]).x);
    hash.add_all(crossed(random, queries[i], queries[(i + 2) % queries.size()]).x);
    const Query apart = mutated(random, with_separation(queries[i], 0.375));
    of_separations.add(apart.separation);
    of_separations.add(crossed(random, apart, queries[i]).separation);
  }
  EXPECT_EQ(hash.value(), 0x6eb9a92da015cf1d) << std::hex << hash.value();
  EXPECT_EQ(of_separations.value(), 0x39d0aa99704c5c4b) << std::hex << of_separations.value();
}

// --- places ---------------------------------------------------------------------------------------------

/// The vector between the two points of a Place, one on each primitive, computed in more bits than a double
/// has.
std::array<long double, 3> gap(const Query& query, const Place& place) {
  const long double alpha = place.alpha;
  const long double beta = place.beta;
  const long double time = place.time;
  std::array<long double, 4> weights{1, alpha + beta - 1, -alpha, -beta};
  if (query.kind == Kind::edge_edge) weights = {1 - alpha, alpha, beta - 1, -beta};
  std::array<long double, 3> sum{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      sum[k] += weights[i] * ((1 - time) * query.x[3 * i + k] + time * query.x[12 + 3 * i + k]);
  return sum;
}

bool is_zero(const std::array<long double, 3>& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

TEST(Place, JoinedPointsAreOneWhereDoublesAllowIt) {
  const Place place{.alpha = 0.25, .beta = 0.25, .time = 0.5};  // all weights are powers of two
  for (std::uint64_t i = 0; i < 100; ++i) {
    const Query query = make_query(find_family("small-integer"), 1, 2 * i);
    for (const int point : movable_points(query.kind, place)) {
      const Query touching = joined(query, place, point);
      ASSERT_TRUE(is_zero(gap(touching, place))) << i << ", " << point;
      ASSERT_TRUE(collides(touching)) << i << ", " << point;
    }
  }
}

TEST(Place, ItsOwnIsWhereThePrimitivesTouch) {
  Random random(3, 0, 0);
  const Place falling = own_place(random, testing::falling_vertex(0.25, 0.5, 1, -3));
  EXPECT_EQ(falling.time, 0.25);
  EXPECT_EQ(falling.alpha, 0.25);
  EXPECT_EQ(falling.beta, 0.5);
  const Place crossing = own_place(random, testing::falling_edge(1, -1));
  EXPECT_EQ(crossing.time, 0.5);
  EXPECT_EQ(crossing.alpha, 0.5);
  EXPECT_EQ(crossing.beta, 0.5);
}

// --- libFuzzer's inputs ---------------------------------------------------------------------------------

Query some_query(double separation) {
  return with_separation(make_query(find_family("uniform"), 8, 0), separation);
}

using Bytes = std::array<std::uint8_t, libfuzzer::query_bytes>;

TEST(QueryBytes, AreReadBack) {
  for (const double separation : {0.0, 0.1, std::numeric_limits<double>::denorm_min()}) {
    for (const Kind kind : kinds) {
      Query query = some_query(separation);
      query.kind = kind;
      repeat_vertices(query);
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
