// Mutations make the contacts, the roots and the planes that their names promise. (mutation_chain_test.cpp records the bits that
// each of them makes.)
#include "fuzz/families/mutation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iostream>
#include <set>
#include <string_view>

#include "ccd/wang/cubic.hpp"
#include "fuzz/families/families.hpp"
#include "oracle/oracle.hpp"
#include "oracle/sturm/sturm.hpp"
#include "tests/fuzz/family_queries.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using testing::first_queries;
using testing::largest_coordinate;

const Mutation& mutation(std::string_view name) {
  const auto all = mutations();
  return *std::find_if(all.begin(), all.end(), [&](const Mutation& each) { return each.name == name; });
}

using BeforeAndAfter = std::function<bool(const Query& before, const Query& after)>;

/// The number of queries, of 1000 of a family, for which something holds before and after a sort of mutation.
int count_of_1000(std::string_view name, std::string_view family, const BeforeAndAfter& holds) {
  int count = 0;
  std::uint64_t number = 0;
  for (const Query& before : first_queries(family, 1000)) {
    Random random(2, 0, number++);
    count += holds(before, mutation(name).apply(random, before)) ? 1 : 0;
  }
  std::cout << name << ", " << family << ": " << count << " of 1000\n";
  return count;
}

/// Applies a sort of mutation to queries of a family. The check must hold for all changed queries, and at
/// least half must change.
void expect_of(std::string_view name, std::string_view family, const BeforeAndAfter& holds) {
  int number = 0;
  const int changed = count_of_1000(name, family, [&](const Query& before, const Query& after) {
    EXPECT_TRUE(after == before || holds(before, after)) << name << ", " << family << ", " << number;
    ++number;
    return after != before;
  });
  EXPECT_GE(changed, 500) << name << ", " << family;
}

/// The positions that differ, 0 .. 3 at t = 0 and 4 .. 7 at t = 1.
std::set<int> changed_positions(const Query& before, const Query& after) {
  std::set<int> changed;
  for (std::size_t i = 0; i < 24; ++i)
    if (before.x[i] != after.x[i]) changed.insert(static_cast<int>(i / 3));
  return changed;
}

// Contact is also planted next to borders and ends. There rounding removes it half of the time.
TEST(Mutation, PlantAndRestoreMakeCollisionsByMovingOnePosition) {
  for (const char* name : {"plant", "restore"})
    for (const char* family : {"uniform", "uniform-slow", "sliver"}) {
      expect_of(name, family, [](const Query& before, const Query& after) {
        return changed_positions(before, after).size() == 1;
      });
      const auto collide = [](const Query&, const Query& after) { return collides(after); };
      EXPECT_GE(count_of_1000(name, family, collide), 500) << name << ", " << family;
    }
}

TEST(Mutation, RestoreKeepsACollisionWhereItIs) {
  int collisions = 0;
  const int kept = count_of_1000("restore", "uniform", [&](const Query& before, const Query& after) {
    if (!earliest_time(before)) return false;
    ++collisions;
    double moved = 0;
    for (std::size_t i = 0; i < 24; ++i) moved = std::max(moved, std::abs(after.x[i] - before.x[i]));
    return moved < 1e-9;
  });
  EXPECT_GE(collisions, 50);
  EXPECT_GE(kept, collisions / 2);  // the others are at another root of F
}

template <Kind kind>
bool has_root_of(const Query& query) {
  return solve_cubic(coplanarity(make_pair<kind, double>(query)), 0.0).count > 0;
}
bool has_root(const Query& query) {
  return query.kind == Kind::vertex_triangle ? has_root_of<Kind::vertex_triangle>(query)
                                             : has_root_of<Kind::edge_edge>(query);
}

TEST(Mutation, CoplanarMakesARootOfFByMovingOnePosition) {
  int without = 0;
  const int made = count_of_1000("coplanar", "uniform-slow", [&](const Query& before, const Query& after) {
    if (has_root(before)) return false;
    EXPECT_EQ(changed_positions(before, after).size(), 1);
    ++without;
    return has_root(after);
  });
  EXPECT_GE(without, 500);
  EXPECT_GE(made, without * 3 / 4);  // at an end rounding may take it away
}

TEST(Mutation, PlanarMakesFZeroIdentically) {
  // Rounding leaves only those that keep to an axis' plane.
  const auto planar = [](const Query&, const Query& after) { return count_roots(after).planar; };
  for (const char* family : {"uniform", "small-integer"})
    EXPECT_GE(count_of_1000("planar", family, planar), 350) << family;
}

TEST(Mutation, ScaleIsByOnePowerOfTwo) {
  expect_of("scale", "small-integer", [](const Query& before, const Query& after) {
    int exponent = 0;
    const double factor = largest_coordinate(after) / largest_coordinate(before);
    return std::frexp(factor, &exponent) == 0.5 && after == testing::scaled(before, factor);
  });
}

TEST(Mutation, ReorderKeepsTheTruth) {
  expect_of("reorder", "grazing", [](const Query& before, const Query& after) {
    return collides(after) == collides(before) &&
           std::is_permutation(after.x.begin(), after.x.end(), before.x.begin());
  });
}

}  // namespace
}  // namespace nearmiss
