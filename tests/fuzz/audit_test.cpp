// The audit of rounding constants.
#include "fuzz/studies/audit.hpp"

#include <gmock/gmock.h>

#include <string_view>
#include <vector>

#include "ccd/wang/motion.hpp"
#include "oracle/oracle.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using ::testing::ElementsAre;

/// The names of all rows with a given property, in both tables of rounding constants.
std::vector<std::string_view> names_of(bool (RoundingConstant::*property)() const) {
  std::vector<std::string_view> names;
  for (const auto& rows : {rounding_bounds(), rounding_consequences()})
    for (const RoundingConstant& row : rows)
      if ((row.*property)()) names.push_back(row.name);
  return names;
}

// The paper assumes that B, the pair's bound, also bounds the relative positions of two edges at any time.
// All constants that depend on this assumption are too small, except δ, the constant of a squared distance.
TEST(Audit, FindsWhatThePaperHasTooSmall) {
  EXPECT_THAT(names_of(&RoundingConstant::is_too_small),
              ElementsAre("VE of EE: weight", "VE of EE: barycentric test", "EE: weight, far p",
                          "EE: barycentric test, far p", "EE: distance from an edge line, far p",
                          "EE: distance of a false positive, far p"));
}

TEST(Audit, KnowsWhatIsProvenThoughTheTheoremDoesNotShowIt) {
  EXPECT_THAT(names_of(&RoundingConstant::needs_proof), ElementsAre("VV of EE: delta"));
}

// §4.1 of the paper says that "B is also an upper bound on the relative positions at any time", where x20 is
// the position of one of the two closest end points relative to the other. In this query, x1 and x2 are the
// closest end points at t = 0, at a distance of 1.5. At t = 1, their distance is 5, which is more than B = 1
// + 3.5.
TEST(Audit, EdgesMayMoveOutOfTheBoundOfTheirClosestPair) {
  const auto x = [](double a) { return Vector3<double>(a, 0, 0); };
  const Query query =
      testing::make_query(Kind::edge_edge, {x(0), x(1), x(2.5), x(3.5)}, {x(3.5), x(1), x(6), x(3.5)});
  ASSERT_TRUE(collides(query));
  auto pair = make_pair<Kind::edge_edge, double>(query);
  pair.order = detail::closest_order<double>(query, pair.frame);
  form_vectors(query, pair);
  EXPECT_EQ(max_component(pair.p.x()), 1.5);
  EXPECT_EQ(max_component(pair.p.at(1.0)), 5);
  EXPECT_NEAR(pair.B, 4.5, 1e-12);
}

}  // namespace
}  // namespace nearmiss
