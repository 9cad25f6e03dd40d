// wang in lanes gives the verdicts of wang for one query at a time, bit for bit. With more queries, such as
// 10^8:
//   NEARMISS_QUERIES=2300000 fuzz_tests --gtest_filter='*InLanes*'
#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "ccd/query/error.hpp"
#include "ccd/subjects/subject.hpp"
#include "ccd/wang/wang_batch.hpp"
#include "tests/fuzz/family_queries.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

bool equal(const Verdict& a, const Verdict& b) {
  return a.hit == b.hit && a.stage == b.stage && a.rejection == b.rejection && a.fault == b.fault &&
         std::bit_cast<std::uint64_t>(a.time) == std::bit_cast<std::uint64_t>(b.time);
}

std::vector<Verdict> in_lanes(std::span<const Query> queries, Instructions instructions) {
  std::vector<Verdict> verdicts(queries.size(), Verdict::accepted(Stage::unknown, 7));
  wang_in_lanes(QueryRows(queries), verdicts, instructions);
  return verdicts;
}

std::vector<Verdict> one_by_one(std::span<const Query> queries) {
  const auto subject = make_subject("wang-scalar");
  std::vector<Verdict> verdicts;
  for (const Query& query : queries) verdicts.push_back(subject->decide(query));
  return verdicts;
}

std::vector<Query> contacts(const Family& family, std::uint64_t first, std::uint64_t count) {
  std::vector<Query> queries;
  for (std::uint64_t i = first; i < first + count; ++i)
    queries.push_back(with_separation(nearmiss::make_query(family, 26, i), 0));
  return queries;
}

class InLanes : public ::testing::TestWithParam<Family> {};

TEST_P(InLanes, VerdictsAreThoseOfOneQueryAtATime) {
  constexpr std::uint64_t most = 4000;
  for (std::uint64_t first = 0; first < testing::query_count(4000); first += most) {
    const auto queries = contacts(GetParam(), first, std::min(most, testing::query_count(4000) - first));
    const auto expected = one_by_one(queries);
    for (const Instructions instructions : all_instructions) {
      if (!has(instructions)) continue;
      const auto verdicts = in_lanes(queries, instructions);
      for (std::size_t i = 0; i < queries.size(); ++i) {
        if (is_decided(verdicts[i])) {
          ASSERT_TRUE(equal(verdicts[i], expected[i]))
              << GetParam().name << ":26:" << first + i << " in " << lanes(instructions) << " lanes";
        }
      }
    }
    std::vector<Verdict> all(queries.size());
    make_subject("wang")->decide(queries, all);
    for (std::size_t i = 0; i < queries.size(); ++i) ASSERT_TRUE(equal(all[i], expected[i]));
  }
}

INSTANTIATE_TEST_SUITE_P(Families, InLanes, ::testing::ValuesIn(families().begin(), families().end()),
                         testing::name_of_test);

std::size_t decided(const std::vector<Verdict>& verdicts) {
  return static_cast<std::size_t>(std::ranges::count_if(verdicts, is_decided));
}

TEST(WangInLanes, DecidesNearlyAllUniformQueries) {
  const auto queries = contacts(find_family("uniform"), 0, 20000);
  EXPECT_GE(decided(in_lanes(queries, widest_instructions())), 19980U);
}

TEST(WangInLanes, TakesAnyNumberOfQueries) {
  const auto queries = contacts(find_family("touch-twice"), 0, 300);
  for (const Instructions instructions : all_instructions) {
    if (!has(instructions)) continue;
    const auto expected = in_lanes(queries, instructions);
    for (const std::size_t count : {0U, 1U, 2U, 3U, 7U, 127U, 128U, 129U, 257U, 300U}) {
      const auto verdicts = in_lanes(std::span(queries).first(count), instructions);
      for (std::size_t i = 0; i < count; ++i)
        ASSERT_TRUE(equal(verdicts[i], expected[i])) << i << " of " << count;
    }
  }
}

TEST(WangInLanes, LeavesCoordinatesThatAreNotFinite) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double c : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
    std::vector<Query> queries;
    for (std::size_t i = 0; i < 24; ++i) {
      queries.push_back(testing::falling_vertex(2, 2, 1, 1));  // apart, whatever the value of number i
      queries.back().x[i] = c;
    }
    for (const Instructions instructions : all_instructions)
      if (has(instructions)) {
        EXPECT_EQ(decided(in_lanes(queries, instructions)), 0U);
      }
    std::vector<Verdict> verdicts(queries.size());
    EXPECT_THROW(make_subject("wang")->decide(queries, verdicts), Error);
  }
}

TEST(WangInLanes, AGivenBoundDecidesAsForOneQuery) {
  const auto queries = contacts(find_family("uniform"), 0, 2000);
  const auto subject = make_subject("wang@16");
  std::vector<Verdict> verdicts(queries.size());
  subject->decide(queries, verdicts);
  for (std::size_t i = 0; i < queries.size(); ++i)
    ASSERT_TRUE(equal(verdicts[i], subject->decide(queries[i])));
}

}  // namespace
}  // namespace nearmiss
