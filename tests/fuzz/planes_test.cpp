// The plane tests of the oracle and those of the subjects agree on every family, although they share no code.
#include <gtest/gtest.h>

#include "ccd/wang/plane_culling.hpp"
#include "fuzz/families/families.hpp"
#include "oracle/filter/planes.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

template <Kind kind>
void expect_same(const Query& query, const std::string& provenance) {
  const auto x = coordinates(query);
  EXPECT_EQ(certified::separated_across_axes<kind>(x), detail::separated_across_axis<kind>(x)) << provenance;
  EXPECT_EQ(certified::separated_across_diagonals<kind>(x), detail::separated_across_diagonal<kind>(x))
      << provenance;
}

TEST(Planes, AreThoseOfTheAccusedOnEveryFamily) {
  constexpr std::uint64_t seed = 11;
  for (const Family& family : families()) {
    for (std::uint64_t i = 0; i < 5000; ++i) {
      const Query query = make_query(family, seed, i);
      const std::string provenance = family.name + ":" + std::to_string(seed) + ":" + std::to_string(i);
      if (query.kind == Kind::vertex_triangle)
        expect_same<Kind::vertex_triangle>(query, provenance);
      else
        expect_same<Kind::edge_edge>(query, provenance);
      ASSERT_FALSE(::testing::Test::HasFailure());
    }
  }
}

TEST(Planes, TouchingIsNotSeparate) {
  const Query touching = testing::falling_vertex(0, 0, 0, 1);
  EXPECT_FALSE(certified::separated_across_axes<Kind::vertex_triangle>(coordinates(touching)));
  const Query apart = testing::falling_vertex(0, 0, 0x1p-1074, 1);
  EXPECT_TRUE(certified::separated_across_axes<Kind::vertex_triangle>(coordinates(apart)));
  const Query through = testing::falling_vertex(0, 0, 1, -1);
  EXPECT_FALSE(certified::separated_across_axes<Kind::vertex_triangle>(coordinates(through)));
}

}  // namespace
}  // namespace nearmiss
