#include "fuzz/subjects/contracted.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "oracle/exact/predicates.hpp"
#include "oracle/exact/root.hpp"
#include "tests/queries.hpp"
#include "tests/random_queries.hpp"

namespace nearmiss {
namespace {

using testing::falling_vertex;

/// A vertex at a height above the triangle with the corners (0 0 0), (width 0 0) and (0 1 0). Width and
/// height change linearly, and F, the coplanarity cubic, is a multiple of their product.
Query two_factors(double width_start, double width_end, double height_start, double height_end) {
  Query query = falling_vertex(0.25, 0.25, height_start, height_end);
  query.set_start(2, {width_start, 0, 0});
  query.set_end(2, {width_end, 0, 0});
  return query;
}

TEST(Contract, NothingIsTakenForGranted) { EXPECT_TRUE(keeps_contract(Query{}, {})); }

TEST(Contract, ApartAtTheStart) {
  const auto keeps = [](double start, double by) {
    return keeps_contract(falling_vertex(0.25, 0.25, start, -1), {.apart_at_start = true, .apart_by = by});
  };
  for (const double by : {0.0, std::numeric_limits<double>::denorm_min(), 0x1p-600, 1e-8, 1.0, 0x1p600}) {
    EXPECT_FALSE(keeps(by, by)) << by;
    EXPECT_TRUE(keeps(std::nextafter(by, HUGE_VAL), by)) << by;
    EXPECT_FALSE(keeps(0, by)) << by;
  }
  EXPECT_FALSE(keeps_contract(falling_vertex(0.25, 0.25, 0, 0), {.apart_at_start = true}));
  const Query comes_near_later = falling_vertex(0.25, 0.25, 1, 0);
  EXPECT_TRUE(keeps_contract(comes_near_later, {.apart_at_start = true, .apart_by = 1e-8}));
}

TEST(Contract, OneRoot) {
  const Contract contract{.one_root = true};
  const auto keeps = [&](const Query& query) { return keeps_contract(query, contract); };
  EXPECT_TRUE(keeps(falling_vertex(0.25, 0.25, 1, -1)));
  EXPECT_TRUE(keeps(falling_vertex(0.25, 0.25, 2, 1)));
  // The comments give the roots of F.
  EXPECT_TRUE(keeps(falling_vertex(0.25, 0.25, 1, 0)));      // at the end
  EXPECT_TRUE(keeps(falling_vertex(0.25, 0.25, 0, 1)));      // at the start
  EXPECT_FALSE(keeps(falling_vertex(0.25, 0.25, 0, 0)));     // always
  EXPECT_FALSE(keeps(two_factors(1, -1, 1, -3)));            // at 1/2 and 1/4
  EXPECT_FALSE(keeps(two_factors(1, -1, 1, -1)));            // at 1/2, twice
  EXPECT_FALSE(keeps(two_factors(0, 1, 0, 1)));              // at 0, twice
  EXPECT_TRUE(keeps(two_factors(-1, -2, -1, -2)));           // at -1, twice
  EXPECT_FALSE(keeps(two_factors(1, -1, 0, 1)));             // at 1/2 and 0
  EXPECT_FALSE(keeps(two_factors(1, 0, 0, 1)));              // at both ends
  EXPECT_FALSE(keeps(two_factors(1, -1, 1, -1 - 0x1p-52)));  // at 1/2, and just before 1/2
}

TEST(Contract, OneRootIsDecidedAsByExactArithmetic) {
  Random random(24, 0, 0);
  int kept = 0;
  for (std::size_t i = 0; i < 1000; ++i) {
    const Kind kind = testing::kind_of_case(i);
    const Query query =
        i % 3 == 0 ? testing::integer_query(random, kind, 2) : testing::uniform_query(random, kind);
    exact::Predicates predicates(query);
    const exact::Polynomial& F = predicates.F();
    const auto has_double_root = [&] {
      const auto factor = exact::greatest_common_divisor(F, F.derivative());
      return factor.degree() > 0 && !exact::roots_in_step(factor).empty();
    };
    const bool expected = !F.is_zero() && exact::roots_in_step(F).size() <= 1 && !has_double_root();
    ASSERT_EQ(keeps_contract(query, {.one_root = true}), expected) << testing::repeat(i, query);
    kept += expected ? 1 : 0;
  }
  EXPECT_GT(kept, 150);
  EXPECT_LT(kept, 950);
}

TEST(Contract, Grid) {
  const auto keeps = [](double x, double grid) {
    Query query;
    query.x[23] = x;
    return keeps_contract(query, {.grid = grid});
  };
  EXPECT_TRUE(keeps(0x1p-10, 0x1p-10));
  EXPECT_TRUE(keeps(-3 * 0x1p-10, 0x1p-10));
  EXPECT_FALSE(keeps(0x1p-11, 0x1p-10));
  EXPECT_FALSE(keeps(1 + 0x1p-11, 0x1p-10));
  EXPECT_TRUE(keeps(1e308, 0x1p-1074));
  EXPECT_TRUE(keeps(0x1p1023, 0x1p1023));
  EXPECT_FALSE(keeps(0x1p1022, 0x1p1023));
}

TEST(Contract, LengthsOfEdgesAndPaths) {
  const Query query = falling_vertex(0.25, 0.25, 0.5, 0.25);  // the edges are 1, 1 and √2 long
  const double just_above = std::sqrt(2.0);                   // √2, rounded up
  EXPECT_TRUE(keeps_contract(query, {.longest = just_above}));
  EXPECT_FALSE(keeps_contract(query, {.longest = std::nextafter(just_above, 0)}));
  EXPECT_TRUE(keeps_contract(query, {.shortest = 1}));
  EXPECT_FALSE(keeps_contract(query, {.shortest = std::nextafter(1.0, 2)}));
  const Query shrinking = two_factors(1, 0.5, 0.5, 0.25);
  EXPECT_FALSE(keeps_contract(shrinking, {.shortest = 1}));
  EXPECT_TRUE(keeps_contract(shrinking, {.shortest = 0.5}));
  Query edges{.kind = Kind::edge_edge};
  edges.set_start(1, {1, 0, 0});
  edges.set_end(1, {1, 0, 0});
  EXPECT_FALSE(keeps_contract(edges, {.shortest = 1}));  // one edge is a point
  EXPECT_TRUE(keeps_contract(edges, {.longest = 1}));
  const Query path = falling_vertex(0.25, 0.25, 1, -1);
  EXPECT_TRUE(keeps_contract(path, {.longest = 2}));
  EXPECT_FALSE(keeps_contract(path, {.longest = std::nextafter(2.0, 0)}));
}

TEST(Contract, LengthsAtTheEndsOfDouble) {
  constexpr double most = std::numeric_limits<double>::max();
  constexpr double least = std::numeric_limits<double>::denorm_min();
  Query query{.kind = Kind::edge_edge};
  for (const int time : {0, 1})
    for (const int edge : {0, 1}) {
      query.x[static_cast<std::size_t>(12 * time + 6 * edge)] = -most;
      query.x[static_cast<std::size_t>(12 * time + 6 * edge + 3)] = 0;
    }
  EXPECT_TRUE(keeps_contract(query, {.shortest = most, .longest = most}));
  query.x[3] = least;
  EXPECT_FALSE(keeps_contract(query, {.longest = most}));
  query.x[3] = most;
  EXPECT_FALSE(keeps_contract(query, {.longest = most}));
  Query tiny{.kind = Kind::edge_edge};
  for (const std::size_t i : {0U, 6U, 12U, 18U}) tiny.x[i] = least;
  EXPECT_TRUE(keeps_contract(tiny, {.shortest = least, .longest = least}));
  EXPECT_FALSE(keeps_contract(tiny, {.shortest = 2 * least}));
}

}  // namespace
}  // namespace nearmiss
