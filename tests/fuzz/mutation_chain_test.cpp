// Chains of mutations, and crossings, are pure functions, make finite numbers, and keep collisions. Also
// tests what they do to a query's separation, and libFuzzer's inputs with a separation.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "fuzz/families/families.hpp"
#include "fuzz/families/mutation.hpp"
#include "fuzz/libfuzzer/query_bytes.hpp"
#include "oracle/oracle.hpp"
#include "tests/bit_hash.hpp"
#include "tests/fuzz/family_queries.hpp"

namespace nearmiss {
namespace {

using testing::first_queries;

TEST(Mutated, IsAPureFunctionOfTheStreamAndTheQuery) {
  const Query query = make_query(find_family("uniform"), 1, 0);
  Random one(3, 4, 5);
  Random same(3, 4, 5);
  Random other(3, 4, 6);
  const Query result = mutated(one, query);
  EXPECT_EQ(mutated(same, query), result);
  EXPECT_NE(mutated(other, query), result);
}

/// Queries to start from: some of each family, and some with extreme coordinates.
std::vector<Query> seeds() {
  std::vector<Query> queries;
  for (const Family& family : families())
    for (std::uint64_t i = 0; i < 16; ++i) queries.push_back(make_query(family, 5, i));
  for (const Kind kind : kinds_of_meshes) {
    for (const double size : {1e-100, 1e-150, 1e-300}) {  // small primitives, far apart along x
      Query query{.kind = kind};
      for (std::size_t i = 0; i < 24; ++i) query.x[i] = size * std::sqrt(i);
      for (int i = split(kind); i < 4; ++i) {
        query.x[3 * static_cast<std::size_t>(i)] = 1 / size;
        query.x[12 + 3 * static_cast<std::size_t>(i)] = 1 / size;
      }
      queries.push_back(query);
    }
    for (const double extreme : {0.0, std::numeric_limits<double>::max(), std::numeric_limits<double>::min(),
                                 std::numeric_limits<double>::denorm_min()}) {
      Query query{.kind = kind};
      for (std::size_t i = 0; i < 24; ++i) query.x[i] = i % 3 == 0 ? -extreme : extreme;
      queries.push_back(query);
      query.x[7] = 1;
      queries.push_back(query);
    }
  }
  return queries;
}

TEST(Mutated, IsAnotherFiniteQueryHoweverLongTheChain) {
  const auto starts = seeds();
  for (std::uint64_t chain = 0; chain < 100'000; ++chain) {
    Query query = starts[chain % starts.size()];
    for (std::uint64_t step = 0; step < 8; ++step) {
      Random random(6, chain, step);
      const Query next = mutated(random, query);
      ASSERT_TRUE(is_finite(next)) << chain << ", " << step;
      ASSERT_NE(next, query) << chain << ", " << step;
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
  std::cout << collisions << " of " << chains * steps << " collide\n";
  EXPECT_GE(collisions, chains * steps / 2);
}

/// Whether all coordinates of each part come from the same parent.
bool is_by(const std::array<bool, 24>& choice, const std::function<std::size_t(std::size_t)>& part) {
  std::array<std::set<bool>, 24> seen;
  for (std::size_t i = 0; i < 24; ++i) seen[part(i)].insert(choice[i]);
  return std::all_of(seen.begin(), seen.end(), [](const auto& choices) { return choices.size() <= 1; });
}

TEST(Crossed, MixesVerticesAxesMomentsAndCoordinates) {
  const Query first = make_query(find_family("uniform"), 8, 0);
  const Query second = make_query(find_family("uniform"), 8, 1);
  std::set<Kind> seen_kinds;
  int vertices = 0;
  int axes = 0;
  int moments = 0;
  int coordinates = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    Random random(9, 0, i);
    const Query child = crossed(random, first, second);
    seen_kinds.insert(child.kind);
    std::array<bool, 24> from_first{};
    for (std::size_t k = 0; k < 24; ++k) {
      from_first[k] = child.x[k] == first.x[k];
      ASSERT_TRUE(from_first[k] || child.x[k] == second.x[k]);
    }
    if (is_by(from_first, [](std::size_t) { return 0; })) continue;  // all coordinates are from one parent
    if (is_by(from_first, [](std::size_t k) { return k / 3 % 4; }))
      ++vertices;
    else if (is_by(from_first, [](std::size_t k) { return k % 3; }))
      ++axes;
    else if (is_by(from_first, [](std::size_t k) { return k / 12; }))
      ++moments;
    else
      ++coordinates;
  }
  for (const int count : {vertices, axes, moments, coordinates}) EXPECT_GT(count, 50);
  EXPECT_EQ(seen_kinds.size(), 2);
}

/// A hash of the queries that a mutation makes from the first queries of some families.
std::uint64_t fingerprint(const Mutation& kind) {
  testing::BitHash hash;
  for (const char* family : {"uniform", "small-integer", "planted"}) {
    for (std::uint64_t number = 0; const Query& before : first_queries(family, 1000)) {
      Random random(2, 0, number++);
      hash.add_all(kind.apply(random, before).x);
    }
  }
  return hash.value();
}

// A provenance of a search or of libFuzzer names a seed, which must always give the same query.
TEST(Mutation, MakesOfAQueryWhatItAlwaysMade) {
  const std::map<std::string_view, std::uint64_t> recorded{
      {"ulps", 0x62b41b423da15fc0},      {"fraction", 0xa730dd97297b2184},
      {"exponent", 0xc6841d7ed98bb8df},  {"copy-coordinate", 0xcb2a934a54d82229},
      {"round", 0xd6f14054393455ab},     {"plant", 0xd26623bedb6ba432},
      {"restore", 0x2ef35486139e87d1},   {"coplanar", 0x34d7a1cd4535879a},
      {"planar", 0x3971c4205d2c5ba9},    {"shrink-edge", 0x40d23241077732d3},
      {"velocity", 0x3e5bbb8e757351df},  {"copy-vertex", 0xeb075ef310bd0302},
      {"reverse", 0x2e02d853bb7a9ef9},   {"scale", 0x91de2f3d7388c32},
      {"translate", 0xb767d8dbed16b18c}, {"reorder", 0x3fa8d25d8a4969af}};
  for (const Mutation& kind : mutations())
    EXPECT_EQ(fingerprint(kind), recorded.contains(kind.name) ? recorded.at(kind.name) : 0)
        << kind.name << std::hex << " 0x" << fingerprint(kind);
}

TEST(Mutation, ChainsMakeOfAQueryWhatTheyAlwaysMade) {
  testing::BitHash hash;
  const auto queries = first_queries("uniform", 1000);
  for (std::uint64_t i = 0; i < queries.size(); ++i) {
    Random random(2, 0, i);
    hash.add_all(mutated(random, queries[i]).x);
    hash.add_all(crossed(random, queries[i], queries[(i + 2) % queries.size()]).x);
  }
  EXPECT_EQ(hash.value(), 0x6eb9a92da015cf1d) << std::hex << hash.value();
}

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
