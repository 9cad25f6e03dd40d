// Mutations are pure functions, make finite numbers, and change what their names say.
#include "fuzz/families/mutation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iostream>
#include <limits>
#include <set>
#include <string>
#include <string_view>

#include "ccd/wang/cubic.hpp"
#include "fuzz/families/families.hpp"
#include "oracle/oracle.hpp"
#include "tests/fuzz/family_queries.hpp"
#include "tests/queries.hpp"
#include "tests/root_count.hpp"

namespace nearmiss {
namespace {

using testing::first_queries;
using testing::largest_coordinate;

const Mutation& mutation(std::string_view name) {
  const auto all = mutations();
  return *std::find_if(all.begin(), all.end(), [&](const Mutation& each) { return each.name == name; });
}

using BeforeAndAfter = std::function<bool(const Query& before, const Query& after)>;

/// The number of queries, among 1000 of a family, for which `holds` accepts the query and its mutation.
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

/// Applies a mutation to queries of a family. The check must hold for all changed queries, and at least half
/// must change.
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

std::set<int> changed_vertices(const Query& before, const Query& after) {
  std::set<int> vertices;
  for (const int position : changed_positions(before, after)) vertices.insert(position % 4);
  return vertices;
}

double velocity_difference(const Query& query, int i, const Vector3<double>& velocity) {
  return (query.end(i) - query.start(i) - velocity).norm();
}

TEST(Mutation, UlpsAreFew) {
  expect_of("ulps", "uniform", [](const Query& before, const Query& after) {
    for (std::size_t i = 0; i < 24; ++i)
      if (std::abs(after.x[i] - before.x[i]) > 256 * 0x1p-52 * largest_coordinate(before)) return false;
    return true;
  });
}

TEST(Mutation, AFractionIsOfTheDistanceBetweenTwoPositions) {
  bool one = false;
  bool all = false;
  expect_of("fraction", "uniform", [&](const Query& before, const Query& after) {
    for (std::size_t i = 0; i < 24; ++i)
      if (std::abs(after.x[i] - before.x[i]) > 5.2) return false;  // positions are in [-1, 2]^3
    one |= changed_positions(before, after).size() == 1;
    all |= changed_positions(before, after).size() == 8;
    return true;
  });
  EXPECT_TRUE(one && all);
}

TEST(Mutation, ExponentsChangeAloneOrGoToAnEndOfTheirRange) {
  const auto digits = [](double c) {
    int exponent = 0;
    return std::abs(std::frexp(c, &exponent));
  };
  const std::set<double> ends{0.0, 0.5, digits(std::numeric_limits<double>::max())};
  expect_of("exponent", "uniform", [&](const Query& before, const Query& after) {
    int changed = 0;
    for (std::size_t i = 0; i < 24; ++i) {
      if (digits(after.x[i]) != digits(before.x[i]) && ends.count(digits(after.x[i])) == 0) return false;
      changed += after.x[i] != before.x[i] ? 1 : 0;
    }
    return changed <= 3;
  });
}

TEST(Mutation, ACopiedCoordinateIsAnotherOrItsNegation) {
  expect_of("copy-coordinate", "uniform", [](const Query& before, const Query& after) {
    std::set<double> magnitudes;
    for (const double c : before.x) magnitudes.insert(std::abs(c));
    return std::all_of(after.x.begin(), after.x.end(),
                       [&](double c) { return magnitudes.count(std::abs(c)) == 1; });
  });
}

TEST(Mutation, RoundedCoordinatesAreMultiplesOfAPartOfTheLargest) {
  expect_of("round", "uniform", [](const Query& before, const Query& after) {
    for (std::size_t i = 0; i < 24; ++i) {
      const double units = std::ldexp(after.x[i], 30);  // the largest coordinate is in [1/2, 2]
      const bool multiple = units == std::nearbyint(units);
      if (after.x[i] != before.x[i] && (!multiple || std::abs(after.x[i] - before.x[i]) > 1)) return false;
    }
    return true;
  });
}

// Contact is also planted next to borders and next to ends of the step; there, rounding undoes half of it.
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
  EXPECT_GE(made, without * 3 / 4);  // rounding may remove a root at an end of the step
}

TEST(Mutation, PlanarMakesFZeroIdentically) {
  // After rounding, F is zero only where all vertices are in a plane perpendicular to an axis.
  const auto planar = [](const Query&, const Query& after) { return testing::count_roots(after).planar; };
  for (const char* family : {"uniform", "small-integer"})
    EXPECT_GE(count_of_1000("planar", family, planar), 350) << family;
}

TEST(Mutation, AShrunkEdgeIsShorter) {
  bool to_one_point = false;
  expect_of("shrink-edge", "uniform", [&](const Query& before, const Query& after) {
    const auto vertices = changed_vertices(before, after);
    if (vertices.size() != 1) return false;
    const int moved = *vertices.begin();
    const auto length = [&](const Query& query, int to) {
      return (query.start(moved) - query.start(to)).norm() + (query.end(moved) - query.end(to)).norm();
    };
    bool shorter = false;
    for (int to = 0; to < 4; ++to) {
      shorter |= to != moved && length(after, to) < length(before, to);
      to_one_point |= to != moved && after.start(to) == after.start(moved);
    }
    return shorter;
  });
  EXPECT_TRUE(to_one_point);
}

TEST(Mutation, VelocitiesAreZeroAnothersOrAlongEdges) {
  std::array<int, 3> sorts{};
  expect_of("velocity", "small-integer", [&](const Query& before, const Query& after) {
    const auto vertices = changed_vertices(before, after);
    const int first = *vertices.begin();
    const Vector3<double> velocity = after.end(first) - after.start(first);
    for (const int i : vertices)
      if (velocity_difference(after, i, velocity) > 1e-12) return false;
    if (velocity.isZero()) return ++sorts[0] > 0;
    for (int i = 0; i < 4; ++i)
      if (velocity_difference(before, i, velocity) < 1e-12) return ++sorts[1] > 0;
    for (int i = 0; i < 4; ++i) {
      const Vector3<double> a = before.start((i + 1) % 4) - before.start(i);
      const Vector3<double> b = before.start((i + 2) % 4) - before.start(i);
      if (std::abs(velocity.dot(a.cross(b))) < 1e-9) return ++sorts[2] > 0;
    }
    return false;
  });
  for (const int count : sorts) EXPECT_GT(count, 50);
}

TEST(Mutation, ACopiedVertexIsAnother) {
  expect_of("copy-vertex", "uniform", [](const Query& before, const Query& after) {
    const auto positions = changed_positions(before, after);
    if (changed_vertices(before, after).size() != 1) return false;
    return std::all_of(positions.begin(), positions.end(), [&](int to) {
      for (int from = 0; from < 4; ++from) {
        if (to < 4 ? after.start(to) == before.start(from) : after.end(to - 4) == before.end(from))
          return true;
      }
      return false;
    });
  });
}

TEST(Mutation, ReverseExchangesStartAndEnd) {
  bool all = false;
  expect_of("reverse", "uniform", [&](const Query& before, const Query& after) {
    const auto vertices = changed_vertices(before, after);
    all |= vertices.size() == 4;
    return std::all_of(vertices.begin(), vertices.end(), [&](int i) {
      return after.start(i) == before.end(i) && after.end(i) == before.start(i);
    });
  });
  EXPECT_TRUE(all);
}

TEST(Mutation, ScaleIsByOnePowerOfTwo) {
  expect_of("scale", "small-integer", [](const Query& before, const Query& after) {
    int exponent = 0;
    const double factor = largest_coordinate(after) / largest_coordinate(before);
    return std::frexp(factor, &exponent) == 0.5 && after == testing::scaled(before, factor);
  });
}

TEST(Mutation, TranslateKeepsThePrimitives) {
  bool to_the_origin = false;
  expect_of("translate", "small-integer", [&](const Query& before, const Query& after) {
    for (int i = 0; i < 4; ++i) {
      to_the_origin |= after.start(i).isZero() && !before.start(i).isZero();
      const auto offset = [&](const Query& query) { return query.end(i) - query.start(0); };
      // offsets are up to 2^43, where an ulp is 2^-9
      if ((offset(after) - offset(before)).norm() > 0.01) return false;
    }
    return true;
  });
  EXPECT_TRUE(to_the_origin);
}

TEST(Mutation, ReorderKeepsTheTruth) {
  expect_of("reorder", "grazing", [](const Query& before, const Query& after) {
    return collides(after) == collides(before) &&
           std::is_permutation(after.x.begin(), after.x.end(), before.x.begin());
  });
}

}  // namespace
}  // namespace nearmiss
