// The family `crossed`: each query has the properties that the values of its factors name, contacts are
// exact, and every possible pair of values of two factors occurs.
#include "fuzz/families/crossed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "fuzz/families/contacts.hpp"
#include "oracle/oracle.hpp"
#include "tests/fuzz/family_queries.hpp"
#include "tests/root_count.hpp"

namespace nearmiss::crossed {
namespace {

using testing::at_rest;

constexpr std::uint64_t seed = 5;

/// Whether the primitives touch at a time in [0, 1] in the queries that the family makes with these levels
/// (values of its factors). The contact is exact, without rounding.
bool touches(const Levels& levels) {
  return levels.when() != When::outside && levels.where() != Where::outside;
}

std::string to_text(const Levels& levels) {
  std::string all;
  for (const std::string& each : to_texts(levels)) all += " " + each;
  return all;
}

template <class Check>
void for_each_query(std::uint64_t count, const Check& check) {
  const Family family = find_family("crossed");
  for (std::uint64_t i = 0; i < count; ++i)
    check(levels_of(seed, i), nearmiss::make_query(family, seed, i), i);
}

TEST(Crossed, TouchesWhereItsFactorsSaySo) {
  int touching = 0;
  for_each_query(8000, [&](const Levels& levels, const Query& query, std::uint64_t index) {
    if (!touches(levels)) return;
    ++touching;
    EXPECT_TRUE(collides(query)) << index << to_text(levels);
  });
  EXPECT_GT(touching, 4000);
}

TEST(Crossed, ContactIsAtTheTimeOfItsFactor) {
  for_each_query(3000, [&](const Levels& levels, const Query& query, std::uint64_t index) {
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

/// The number of sign changes of F, the coplanarity cubic, from just before t = 0 to just after t = 1.
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
  // The keys of these maps are values of the factor `roots`. `at_contact` has the values for which the
  // contact is at a multiple root, and gives the multiplicity of this root. For the value `all`, F is zero
  // everywhere, and `at_contact` gives 0. `simple` has the values for which all roots are simple, and gives
  // the number of roots in the step.
  const std::map<Roots, int> at_contact{{Roots::all, 0}, {Roots::double_root, 2}, {Roots::triple, 3}};
  const std::map<Roots, int> simple{{Roots::one, 1}, {Roots::two, 2}, {Roots::three, 3}};
  int counted = 0;
  for_each_query(4000, [&](const Levels& levels, const Query& query, std::uint64_t index) {
    if (levels.when() != When::inside || levels.where() == Where::outside) return;
    ++counted;
    const testing::RootCount roots = testing::count_roots(query);
    const std::string where = std::to_string(index) + to_text(levels);
    EXPECT_EQ(roots.planar, levels.roots() == Roots::all) << where;
    EXPECT_GE(roots.with_multiplicity - (roots.distinct - 1),
              at_contact.contains(levels.roots()) ? at_contact.at(levels.roots()) : 1)
        << where;
    if (levels.scale() != 2 || levels.offset() != 0 || levels.motion() == Motion::rotation) return;
    if (simple.contains(levels.roots())) {
      EXPECT_EQ(sign_changes(query), simple.at(levels.roots())) << where;
    }
  });
  EXPECT_GT(counted, 250);
}

TEST(Crossed, ManyQueriesHaveAllPairsAndOneHasFewCombinations) {
  const Coverage many = coverage(1, 0, 20000);
  EXPECT_EQ(many.pairs.seen, many.pairs.made);
  EXPECT_TRUE(many.pairs.missing.empty());
  EXPECT_EQ(many.triples.seen + many.triples.missing.size(), many.triples.made);
  EXPECT_GT(many.triples.made, 4000);
  const Coverage one = coverage(1, 0, 1);
  EXPECT_EQ(one.pairs.seen, 21);
  EXPECT_EQ(one.triples.seen, 35);
  EXPECT_EQ(one.pairs.missing.size(), one.pairs.made - 21);
  for (const char* pair :
       {"motion=rest when=at-1", "shape=point where=inside", "motion=translation roots=two"})
    EXPECT_EQ(std::count(one.pairs_not_made.begin(), one.pairs_not_made.end(), pair), 1) << pair;
}

}  // namespace
}  // namespace nearmiss::crossed
