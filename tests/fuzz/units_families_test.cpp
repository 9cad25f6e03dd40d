// Families in the units of simulations: `metres`, and two whose truth cannot change along their parameters.
#include <gmock/gmock.h>

#include <cmath>

#include "oracle/oracle.hpp"
#include "reports/statistics/family_class.hpp"
#include "tests/fuzz/family_queries.hpp"

namespace nearmiss {
namespace {

using ::testing::ElementsAre;

TEST(UnitsFamily, ScalesTheSameQueriesByPowersOfTwo) {
  for (const char* separation : {"", "~drawn"}) {
    const Family plain = find_family(std::string("units@0") + separation);
    for (const int x : {-30, -10, 7, 30}) {
      const Family scaled = find_family("units@" + std::to_string(x) + separation);
      for (std::uint64_t i = 0; i < 400; ++i) {
        Query expected = make_query(plain, 3, i);
        const bool truth = collides(expected);
        for (double& c : expected.x) c = std::ldexp(c, x);
        expected.separation = std::ldexp(expected.separation, x);
        const Query query = make_query(scaled, 3, i);
        ASSERT_EQ(query, expected) << scaled.name << " " << i;
        ASSERT_EQ(collides(query), truth) << scaled.name << " " << i;
      }
    }
  }
}

TEST(DistantFamily, MovesTheSameQueriesExactly) {
  const Family near = find_family("distant@0");
  for (const int x : {1, 13, 26}) {
    const Family far = find_family("distant@" + std::to_string(x));
    for (std::uint64_t i = 0; i < 400; ++i) {
      const Query before = make_query(near, 3, i);
      const Query after = make_query(far, 3, i);
      for (std::size_t k = 0; k < 24; ++k) {
        // Differences of coordinates are exact in both, and the same.
        ASSERT_EQ(after.x[k] - after.x[k % 3], before.x[k] - before.x[k % 3]) << far.name << " " << i;
      }
      ASSERT_EQ(collides(after), collides(before)) << far.name << " " << i;
    }
    EXPECT_GT(std::abs(make_query(far, 3, 0).x[0]), std::ldexp(1, x - 6));
  }
}

TEST(UnitsFamily, NamesTheFactorByWhichItsAnswersAreCounted) {
  EXPECT_THAT(factors_of(find_family("units@-9"), 1, 5), ElementsAre("edge=2^-9"));
  EXPECT_THAT(factors_of(find_family("v-distant@20~drawn"), 1, 5), ElementsAre("distance=2^20"));
  // Without a fixed value, it is the one that the query drew.
  const Family units = find_family("units");
  for (std::uint64_t i = 0; i < 50; ++i) {
    const std::string factor = factors_of(units, 1, i).at(0);
    ASSERT_EQ(factor.substr(0, 7), "edge=2^");
    ASSERT_EQ(make_query(units, 1, i), make_query(find_family("units@" + factor.substr(7)), 1, i));
  }
}

TEST(MetresFamily, HasTheFactorsThatItNames) {
  const Family metres = find_family("metres");
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Query query = make_query(metres, 1, i);
    const auto factors = factors_of(metres, 1, i);
    ASSERT_EQ(factors.size(), 3);
    const auto value = [&](std::size_t k) { return std::stod(factors[k].substr(factors[k].find('=') + 1)); };
    const double edge = value(0), motion = value(1) * edge, scene = value(2);
    // An edge of the triangle or the second edge; a side's components are at most `edge` at the start.
    const double side = (query.start(3) - query.start(2)).cwiseAbs().maxCoeff();
    ASSERT_LE(side, 2.001 * (edge + motion)) << i;
    for (int v = 0; v < 4; ++v) {
      ASSERT_LE((query.end(v) - query.start(v)).cwiseAbs().maxCoeff(), 8 * motion + 1e-13) << i;
      ASSERT_LE(query.start(v).cwiseAbs().maxCoeff(), scene + 4 * (edge + motion)) << i;
    }
  }
}

TEST(UnitsFamilies, AreOrdinary) {
  for (const char* name : {"metres", "units", "distant", "v-units~drawn", "units@-30", "distant@26"})
    EXPECT_EQ(class_of(name), QueryClass::ordinary) << name;
}

}  // namespace
}  // namespace nearmiss
