// The crossed family: queries have the properties that their factors name, contacts are exact, and all
// combinations of factors occur.
#include "fuzz/families/crossed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "fuzz/families/contacts.hpp"
#include "fuzz/families/coverage.hpp"
#include "oracle/oracle.hpp"
#include "tests/fuzz/family_queries.hpp"
#include "tests/root_count.hpp"

namespace nearmiss::crossed {
namespace {

using testing::at_rest;

constexpr std::uint64_t seed = 5;

/// Calls check(levels, query, index) for queries of both kinds.
template <class Check>
void for_each_query(std::uint64_t count, const Check& check) {
  const Family family = find_family("crossed");
  for (std::uint64_t i = 0; i < count; ++i)
    check(levels_of(seed, i), nearmiss::make_query(family, seed, i), i);
}

TEST(Crossed, TheFactorsAreRecoveredFromSeedAndIndex) {
  const Family family = find_family("crossed");
  for (std::uint64_t i = 0; i < 100; ++i) {
    Random random = random_of(family, seed, i);
    const Levels levels = draw_levels(random);
    EXPECT_EQ(levels, levels_of(seed, i));
    EXPECT_EQ(make_query(random, kind_of(family, i), levels), nearmiss::make_query(family, seed, i));
  }
}

TEST(Crossed, TouchesWhereItsFactorsSaySo) {
  int touching = 0;
  for_each_query(20000, [&](const Levels& levels, const Query& query, std::uint64_t index) {
    if (!touches(levels)) return;
    ++touching;
    EXPECT_TRUE(collides(query)) << index << ' ' << to_text(levels);
  });
  EXPECT_GT(touching, 10000);
}

TEST(Crossed, ContactIsAtTheTimeOfItsFactor) {
  for_each_query(5000, [&](const Levels& levels, const Query& query, std::uint64_t index) {
    if (!touches(levels)) return;
    if (levels.when() == When::at_0) {
      EXPECT_TRUE(collides_exactly(at_rest(query, 0))) << index << to_text(levels);
    } else if (levels.when() == When::at_1) {
      EXPECT_TRUE(collides_exactly(at_rest(query, 1))) << index << to_text(levels);
    } else if (levels.roots() == Roots::one && levels.motion() != Motion::rotation) {
      const double time = earliest_time(query)->enclosure().hi;
      const bool is_early = levels.when() == When::after_0;
      const bool is_late = levels.when() == When::before_1;
      EXPECT_LE(is_late ? 1 - 1.0 / 32 : is_early ? 0x1p-53 : 1.0 / 16, time) << index << to_text(levels);
      EXPECT_GE(is_late ? 1 - 0x1p-53 : is_early ? 1.0 / 32 : 15.0 / 16, time) << index << to_text(levels);
    }
  });
}

/// How often F changes its sign between a time just before 0 and a time just after 1.
int sign_changes(const Query& query) {
  const auto at = [&](int vertex, double t) -> Vector3<double> {
    return query.start(vertex) + t * (query.end(vertex) - query.start(vertex));
  };
  int changes = 0;
  double before = 0;
  for (int i = -1; i <= 65; ++i) {
    const double t = (i + 0.4) / 65;
    const Vector3<double> p = at(0, t);
    const double F = (at(1, t) - p).cross(at(2, t) - p).dot(at(3, t) - p);
    if (before * F < 0) ++changes;
    before = F;
  }
  return changes;
}

TEST(Crossed, FHasTheRootsOfItsFactor) {
  // The roots at the contact, counted with multiplicity, and the simple roots in the step.
  const std::map<Roots, int> at_contact{{Roots::all, 0}, {Roots::double_root, 2}, {Roots::triple, 3}};
  const std::map<Roots, int> simple{{Roots::one, 1}, {Roots::two, 2}, {Roots::three, 3}};
  int counted = 0;
  for_each_query(8000, [&](const Levels& levels, const Query& query, std::uint64_t index) {
    if (levels.when() != When::inside || levels.where() == Where::outside) return;
    ++counted;
    const testing::RootCount roots = testing::count_roots(query);
    const std::string where = std::to_string(index) + " " + to_text(levels);
    EXPECT_EQ(roots.planar, levels.roots() == Roots::all) << where;
    EXPECT_GE(roots.with_multiplicity - (roots.distinct - 1),
              at_contact.contains(levels.roots()) ? at_contact.at(levels.roots()) : 1)
        << where;
    if (levels.scale() != 2 || levels.offset() != 0 || levels.motion() == Motion::rotation) return;
    if (simple.contains(levels.roots())) {
      EXPECT_EQ(sign_changes(query), simple.at(levels.roots())) << where;
    }
  });
  EXPECT_GT(counted, 500);
}

TEST(Crossed, RestAndPointsAreWhatTheyAreCalled) {
  for_each_query(20000, [&](const Levels& levels, const Query& query, std::uint64_t index) {
    if (levels.motion() == Motion::rest) {
      for (int i = 1; i < 4; ++i)
        EXPECT_EQ(query.end(i) - query.start(i), query.end(0) - query.start(0)) << index;
    }
    const auto edges = testing::edges(query, 0);
    if (levels.when() != When::at_0) return;
    const auto is_zero = [](const auto& edge) { return edge.isZero(); };
    EXPECT_TRUE(levels.shape() != Shape::zero_edge || std::any_of(edges.begin(), edges.end(), is_zero))
        << index;
    EXPECT_TRUE(levels.shape() != Shape::point || std::all_of(edges.begin(), edges.end(), is_zero)) << index;
  });
}

TEST(Crossed, AllPairsOccurIn100000Queries) {
  const Coverage found = coverage(1, 0, 100000);
  EXPECT_EQ(found.pairs.seen, found.pairs.made);
  EXPECT_TRUE(found.pairs.missing.empty()) << found.pairs.missing.front();
  EXPECT_EQ(found.triples.seen + found.triples.missing.size(), found.triples.made);
  EXPECT_GT(found.triples.made, 4000);
}

TEST(Crossed, FewQueriesMissCombinations) {
  const Coverage found = coverage(1, 0, 1);
  EXPECT_EQ(found.pairs.seen, 21);
  EXPECT_EQ(found.triples.seen, 35);
  EXPECT_EQ(found.pairs.missing.size(), found.pairs.made - 21);
}

TEST(Crossed, PairsThatAreNotMadeAreListed) {
  const auto not_made = coverage(1, 0, 1).pairs_not_made;
  for (const char* pair :
       {"motion=rest when=at-1", "shape=point where=inside", "motion=translation roots=two"})
    EXPECT_EQ(std::count(not_made.begin(), not_made.end(), pair), 1) << pair;
}

}  // namespace
}  // namespace nearmiss::crossed
