// The factors of the families `units`, `distant` and `metres`, such as "edge=2^-9".
#include <gmock/gmock.h>

#include <cmath>

#include "tests/fuzz/family_queries.hpp"

namespace nearmiss {
namespace {

using ::testing::ElementsAre;

TEST(UnitsFamily, NamesTheFactorByWhichItsAnswersAreCounted) {
  EXPECT_THAT(factors_of(find_family("units@-9"), 1, 5), ElementsAre("edge=2^-9"));
  EXPECT_THAT(factors_of(find_family("v-distant@20~drawn"), 1, 5), ElementsAre("distance=2^20"));
  // If the family's parameter has no fixed value, a value is drawn for each query, and the factor has this
  // value.
  const Family units = find_family("units");
  for (std::uint64_t i = 0; i < 50; ++i) {
    const std::string factor = factors_of(units, 1, i).at(0);
    ASSERT_EQ(factor.substr(0, 7), "edge=2^");
    ASSERT_EQ(make_query(units, 1, i), make_query(find_family("units@" + factor.substr(7)), 1, i));
  }
}

TEST(MetresFamily, HasTheFactorsThatItNames) {
  const Family metres = find_family("metres");
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Query query = make_query(metres, 1, i);
    const auto factors = factors_of(metres, 1, i);
    ASSERT_EQ(factors.size(), 3);
    const auto value = [&](std::size_t k) { return std::stod(factors[k].substr(factors[k].find('=') + 1)); };
    const double edge = value(0), motion = value(1) * edge, scene = value(2);
    // The family draws two sides, whose components are at most `edge` at the start. In a vertex-triangle
    // query, x2x3 is one of these sides, or their difference. In an edge-edge query, x2x3 is one of these
    // sides.
    const double side = (query.start(3) - query.start(2)).cwiseAbs().maxCoeff();
    ASSERT_LE(side, 2.001 * (edge + motion)) << i;
    for (int v = 0; v < 4; ++v) {
      ASSERT_LE((query.end(v) - query.start(v)).cwiseAbs().maxCoeff(), 8 * motion + 1e-13) << i;
      ASSERT_LE(query.start(v).cwiseAbs().maxCoeff(), scene + 4 * (edge + motion)) << i;
    }
  }
}

}  // namespace
}  // namespace nearmiss
