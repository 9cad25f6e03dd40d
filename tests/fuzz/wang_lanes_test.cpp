// In lanes, wang decides several queries at once. Its verdicts must be the same, bit for bit, as those of
// wang for one query at a time. To test more queries, such as 10^8:
//   NEARMISS_QUERIES=2300000 fuzz_tests --gtest_filter='*InLanes*'
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ccd/query/error.hpp"
#include "ccd/subjects/subject.hpp"
#include "ccd/wang/pair_bound.hpp"
#include "ccd/wang/wang.hpp"
#include "ccd/wang/wang_batch.hpp"
#include "tests/fuzz/family_queries.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

bool equal(const Verdict& a, const Verdict& b) {
  return a.hit == b.hit && a.stage == b.stage && a.rejection == b.rejection && a.fault == b.fault &&
         std::bit_cast<std::uint64_t>(a.time) == std::bit_cast<std::uint64_t>(b.time);
}

std::vector<Verdict> in_lanes(std::span<const Query> queries, Instructions instructions,
                              const std::optional<double>& given = std::nullopt) {
  std::vector<Verdict> verdicts(queries.size(), Verdict::accepted(Stage::unknown, 7));
  wang_in_lanes(QueryRows(queries), verdicts, given, instructions);
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

/// A verdict, or the message of the error that took its place.
struct Answer {
  Verdict verdict;
  std::string error;
};

template <class Decide>
Answer answer_of(const Decide& decide) {
  try {
    return {decide(), ""};
  } catch (const Error& error) {
    return {{}, error.what()};
  }
}

/// The answers of wang with the bound `given`. wang_careful() decides every pair that no plane separates,
/// although wang itself calls wang_careful() only for pairs that may need another scale.
std::vector<Answer> careful(std::span<const Query> queries, double given) {
  const auto decide = [&]<Kind kind>(const Query& query) {
    if (separated_by_plane<kind>(query)) return Verdict::rejected(Rejection::planes);
    return detail::wang_careful<kind, double, WangOptions{}>(query, given, PaperTolerances{});
  };
  std::vector<Answer> answers;
  for (const Query& query : queries)
    answers.push_back(answer_of(
        [&] { return with_kind(query.kind, [&]<Kind kind>() { return decide.operator()<kind>(query); }); }));
  return answers;
}

/// Bounds B to give to wang. Some are at or beyond an end of the range in which no scaling is needed. The
/// others are made from the queries' own bounds: some multiply the largest own bound, or another one, by a
/// factor from 1 to 2^60; others are the doubles just below an own bound.
std::vector<double> bounds_for(std::span<const Query> queries) {
  constexpr double most = std::numeric_limits<double>::max();
  std::vector<double> own;
  for (const Query& query : queries) own.push_back(std::min(pair_bound(query), most));
  std::vector<double> bounds{0x1p-1074, 0x1p-101, 0x1p-100, 0x1p100, 0x1.8p100, 0x1p300, most};
  const double largest = std::ranges::max(own);
  for (std::size_t i = 0; const double factor : {1.0, 1.25, 0x1p1, 0x1p4, 0x1p20, 0x1p60}) {
    const double one = own[i++ % own.size()];
    for (const double bound : {factor * largest, factor * one, std::nextafter(one, 0.0)})
      if (bound > 0 && bound <= most) bounds.push_back(bound);
  }
  return bounds;
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

TEST_P(InLanes, AGivenBoundChangesNoAnswer) {
  constexpr std::uint64_t most = 400;
  for (std::uint64_t first = 0; first < testing::query_count(most); first += most) {
    const auto queries = contacts(GetParam(), first, std::min(most, testing::query_count(most) - first));
    for (const double given : bounds_for(queries)) {
      const auto expected = careful(queries, given);
      const auto expect_equal = [&](std::size_t i, const Answer& answer) {
        ASSERT_EQ(answer.error, expected[i].error) << GetParam().name << ":26:" << first + i << " @" << given;
        ASSERT_TRUE(equal(answer.verdict, expected[i].verdict))
            << GetParam().name << ":26:" << first + i << " @" << given;
      };
      for (const Instructions instructions : all_instructions) {
        if (!has(instructions)) continue;
        const auto verdicts = in_lanes(queries, instructions, given);
        for (std::size_t i = 0; i < queries.size(); ++i)
          if (is_decided(verdicts[i])) expect_equal(i, {verdicts[i], ""});
      }
      const auto scalar = make_subject("wang-scalar", given);
      for (std::size_t i = 0; i < queries.size(); ++i)
        expect_equal(i, answer_of([&] { return scalar->decide(queries[i]); }));
      // If a query's own bound is larger than the given bound, the whole batch fails, with the error of the
      // first such query.
      const auto refused =
          std::ranges::find_if(expected, [](const Answer& each) { return !each.error.empty(); });
      const auto answered = static_cast<std::size_t>(refused - expected.begin());
      std::vector<Verdict> verdicts(queries.size());
      const auto wang = make_subject("wang", given);
      const Answer batch = answer_of([&] {
        wang->decide(queries, verdicts);
        return Verdict();
      });
      ASSERT_EQ(batch.error, refused == expected.end() ? "" : refused->error);
      for (std::size_t i = 0; i < answered; ++i) expect_equal(i, {verdicts[i], ""});
    }
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
  // No query's own bound exceeds 3: along each axis, edges are at most 1, and relative velocities at most 2.
  EXPECT_GE(decided(in_lanes(queries, widest_instructions(), 3)), 19980U);
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
      queries.push_back(testing::falling_vertex(2, 2, 1, 1));  // apart, whatever x[i] becomes
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

}  // namespace
}  // namespace nearmiss
