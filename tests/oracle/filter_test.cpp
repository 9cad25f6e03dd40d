// The filter never gives a wrong answer, and decides the queries that it should. A query gets the same answer
// from the filter whether it is asked alone or among many queries.
#include "oracle/filter/filter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "oracle/filter/box.hpp"
#include "oracle/oracle.hpp"
#include "tests/oracle/hard_queries.hpp"
#include "tests/queries.hpp"
#include "tests/random_queries.hpp"

namespace nearmiss {
namespace {

using testing::Hard;

/// Whether `stage`, the filter's answer to a query, agrees with exact arithmetic or is `undecided`.
::testing::AssertionResult is_right(FilterStage stage, std::size_t index, const Query& query) {
  if (stage == FilterStage::undecided || is_collision(stage) == collides_exactly(query))
    return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "wrong by " << filter_stage_names[static_cast<std::size_t>(stage)]
                                       << ", " << testing::repeat(index, query);
}

TEST(Filter, NeverContradictsExactArithmetic) {
  for (std::size_t i = 0; i < 30000; ++i) {
    const Query query = Hard(3, i).query();
    ASSERT_TRUE(is_right(filter(query), i, query));
  }
}

TEST(Filter, NeverContradictsExactArithmeticOnSmallIntegers) {
  for (std::size_t i = 0; i < 30000; ++i) {
    Random random(4, 0, i);
    const Query query = testing::integer_query(random, testing::kind_of_case(i), 3);
    ASSERT_TRUE(is_right(filter(query), i, query));
  }
}

TEST(Filter, DecidesPlainQueries) {
  using testing::falling_edge;
  using testing::falling_vertex;
  EXPECT_EQ(filter(falling_vertex(0.25, 0.25, 1, -1)), FilterStage::sign_change);
  EXPECT_EQ(filter(falling_edge(1, -2)), FilterStage::sign_change);
  EXPECT_EQ(filter(falling_vertex(0.25, 0.25, 2, 1)), FilterStage::planes);
  EXPECT_EQ(filter(falling_vertex(0.25, 0.25, 0, 1)), FilterStage::at_an_end);
  EXPECT_EQ(filter(falling_vertex(0.25, 0.25, 1, 0)), FilterStage::at_an_end);
  EXPECT_EQ(filter(falling_edge(0, 1)), FilterStage::at_an_end);
}

TEST(Filter, DecidesWhatTouchesAtADouble) {
  const auto touches = [](const Query& query, const Enclosure& first) {
    KnownTime time;
    EXPECT_EQ(filter(query), FilterStage::at_an_end);
    EXPECT_EQ(filter_for_time(query, time), FilterStage::at_an_end);
    EXPECT_EQ(time.time, first);
  };
  touches(testing::falling_vertex(0.5, 0.5, 1, 0), {1, 1});
  touches(testing::falling_vertex(0.5, 0.5, 1, -1), {0.5, 0.5});  // on an edge
  touches(testing::falling_vertex(0.5, 0.5, 3, -5), {0.375, 0.375});
  touches(Query{}, {0, 0});
  touches({.kind = Kind::edge_edge}, {0, 0});
  const Vector3<double> o(0, 0, 0), a(1, 0, 0);
  touches(testing::make_query(Kind::vertex_triangle, {{0.25, 0.5, -0.25}, o, a, {0, 1, -1}},
                              {{0.25, 0, 0.25}, o, a, {0, 1, 1}}),
          {0, 1});  // t = 0.5 is a double root of F
}

TEST(Filter, DecidesWhatCrossesAnEdgeInAPlaneAcrossAnAxis) {
  KnownTime time;
  EXPECT_EQ(filter(testing::falling_vertex(0, 0.5, 1, -2)), FilterStage::at_an_end);
  EXPECT_EQ(filter_for_time(testing::falling_vertex(0, 0.5, 1, -2), time), FilterStage::at_an_end);
  EXPECT_EQ(time.time, (Enclosure{0x1.5555555555555p-2, 0x1.5555555555556p-2}));
  EXPECT_EQ(filter(testing::falling_vertex(0x1p-1000, 0.5, 1, -2)), FilterStage::sign_change);
  EXPECT_EQ(filter(testing::falling_vertex(-0x1p-1000, 0.5, 1, -2)), FilterStage::planes);
}

TEST(Filter, LeavesWhatTouchesAtAnotherTimeToExactArithmetic) {
  EXPECT_EQ(filter(testing::falling_vertex(0.5, 0.5, 1, -2)), FilterStage::undecided);
}

// --- many at once -----------------------------------------------------------------------------------------

std::vector<FilterStage> filter_all(const std::vector<Query>& queries, Instructions instructions) {
  std::vector<FilterStage> stages(queries.size());
  filter(queries, stages, instructions);
  return stages;
}

std::vector<Query> hard_queries(std::uint64_t seed, std::size_t count) {
  std::vector<Query> queries(count);
  for (std::size_t i = 0; i < count; ++i) queries[i] = Hard(seed, i).query();
  return queries;
}

TEST(BatchFilter, AnswersAsTheFilterOfOneQuery) {
  const auto queries = hard_queries(5, 200000);
  const auto stages = filter_all(queries, widest_instructions());
  std::size_t decided = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const FilterStage alone = filter(queries[i]);
    const bool is_separated = stages[i] == FilterStage::boxes || stages[i] == FilterStage::planes;
    ASSERT_EQ(alone == FilterStage::planes, is_separated) << testing::repeat(i, queries[i]);
    if (stages[i] == FilterStage::undecided) {
      ASSERT_EQ(alone, FilterStage::undecided) << testing::repeat(i, queries[i]);
    }
    if (alone == FilterStage::undecided || stages[i] == FilterStage::undecided) continue;
    ++decided;
    ASSERT_EQ(is_collision(stages[i]), is_collision(alone)) << testing::repeat(i, queries[i]);
  }
  EXPECT_GT(decided, queries.size() / 2);
}

TEST(BatchFilter, ComparesBoxesAsBeforeTheFilterOfOneQuery) {
  std::vector<Query> queries = hard_queries(9, 20000);
  for (std::size_t i = 0; i < 20000; ++i) {
    Random random(10, 0, i);  // boxes of small integers often touch
    queries.push_back(testing::integer_query(random, testing::kind_of_case(i), 2));
    if (i % 8 == 0)
      queries.push_back(testing::scaled(queries.back(), 0x1p1022));  // the sum of coordinates overflows
  }
  const auto stages = filter_all(queries, widest_instructions());
  std::size_t apart = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    ASSERT_EQ(stages[i] == FilterStage::boxes, !boxes_meet(queries[i])) << testing::repeat(i, queries[i]);
    apart += stages[i] == FilterStage::boxes ? 1 : 0;
  }
  EXPECT_GT(apart, queries.size() / 20);
  EXPECT_LT(apart, queries.size() / 2);
}

// The filter guesses where to look for contact. With worse guesses, it would still be right, but would leave
// more queries to exact arithmetic, which is slow. The limit is slightly above the number of queries that the
// filter leaves undecided.
TEST(Filter, LeavesAsFewQueriesAsItDid) {
  std::vector<FilterStage> stages;
  for (const Query& query : hard_queries(5, 50000)) stages.push_back(filter(query));
  EXPECT_LE(std::ranges::count(stages, FilterStage::undecided), 1480);
}

TEST(BatchFilter, NeverContradictsExactArithmetic) {
  const auto queries = hard_queries(6, 30000);
  const auto stages = filter_all(queries, widest_instructions());
  for (std::size_t i = 0; i < queries.size(); ++i) ASSERT_TRUE(is_right(stages[i], i, queries[i]));
}

TEST(BatchFilter, LooksInDoubleWordsNearARoot) {
  // The vertex falls within an ulp of the triangle's longest edge, and reaches the plane at t = 1/3.
  const std::vector<Query> queries{testing::falling_vertex(0.5, 0.5 - 0x1p-54, 1, -2),
                                   testing::falling_vertex(0.5, 0.5 + 0x1p-53, 1, -2),
                                   testing::falling_vertex(0.5, 0.5, 1, -2)};
  std::vector<FilterStage> stages(queries.size());
  filter_with_caution(queries, 1, stages);
  EXPECT_THAT(stages,
              ::testing::ElementsAre(FilterStage::sign_change, FilterStage::weights, FilterStage::undecided));
  filter_with_caution(queries, 2, stages);
  EXPECT_THAT(stages, ::testing::Each(FilterStage::undecided));
}

TEST(BatchFilter, InstructionsChangeNothing) {
  const auto queries = hard_queries(7, 100000);
  const auto stages = filter_all(queries, Instructions::sse2);
  for (const Instructions wider : {Instructions::avx2, Instructions::avx512})
    if (has(wider)) {
      EXPECT_EQ(filter_all(queries, wider), stages);
    }
}

TEST(BatchFilter, TakesAnyNumberOfQueries) {
  const auto queries = hard_queries(8, 300);
  const auto stages = filter_all(queries, widest_instructions());
  for (const std::size_t count : std::array<std::size_t, 7>{0, 1, 7, 127, 128, 129, 300}) {
    const std::vector<Query> some(queries.begin(), queries.begin() + static_cast<std::ptrdiff_t>(count));
    EXPECT_EQ(filter_all(some, widest_instructions()),
              std::vector(stages.begin(), stages.begin() + static_cast<std::ptrdiff_t>(count)));
  }
}

TEST(Filter, LeavesWhatIsNotFinite) {
  for (const double c : {HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    std::vector<Query> queries;
    for (std::size_t i = 0; i < 24; ++i) {
      // The primitives are apart until coordinate i is replaced.
      Query query = testing::falling_vertex(2, 2, 1, 1);
      query.x[i] = c;
      queries.push_back(query);
      EXPECT_EQ(filter(query), FilterStage::undecided);
    }
    const auto stages = filter_all(queries, widest_instructions());
    EXPECT_THAT(stages, ::testing::Each(FilterStage::undecided));
  }
}

}  // namespace
}  // namespace nearmiss
