// A trial as a test of GoogleTest.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <nearmiss/nearmiss.hpp>
#include <nearmiss/trial.hpp>
#include <string>

#include "my_ccd.hpp"

namespace {

using Seconds = std::chrono::duration<double>;

/// The exact answer, as a CCD without a bug.
bool exact(const nearmiss::Question& q) {
  const nearmiss::Kind kind = *nearmiss::kind_of_bit(q.kind);
  std::int8_t answer = -1;
  const auto queries = nearmiss::Queries::packed(kind, std::span(q.x, nearmiss::coordinate_count(kind)));
  nearmiss::collides(queries.with_separation(q.separation), std::span(&answer, 1));
  return answer == NEARMISS_COLLISION;
}

const auto mine = nearmiss::plugin::detector("mine").vertex_triangle(user::point_triangle_ccd);

TEST(MyCcd, ABugIsFoundInASecondAndShownByAnOrdinaryQuery) {
  const auto begin = std::chrono::steady_clock::now();
  const auto report = nearmiss::trial(mine);
  const Seconds took = std::chrono::steady_clock::now() - begin;
  ASSERT_FALSE(report.clean()) << report;
  EXPECT_GT(report.counts(nearmiss::Kind::vertex_triangle).missed, 0U);
  EXPECT_EQ(report.counts(nearmiss::Kind::edge_edge).queries, 0U);
  ASSERT_FALSE(report.findings().empty());
  const nearmiss_trial_finding& first = report.findings().front();
  EXPECT_STREQ(first.what, "false-negative");
  EXPECT_STREQ(first.query_class, "ordinary");
  EXPECT_FALSE(nearmiss::ask(mine, {first.kind, first.x, first.separation}));
  EXPECT_TRUE(exact({first.kind, first.x, first.separation}));
  const std::string text(report.text());
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 15) << text;
  EXPECT_NE(text.find("EXPECT_TRUE(nearmiss::ask(mine, {NEARMISS_VERTEX_TRIANGLE, x, 0}))"),
            std::string::npos)
      << text;
  std::printf("%s%.2f s\n", text.c_str(), took.count());
}

TEST(MyCcd, ARightOnePasses) {
  const auto report = nearmiss::trial(exact, {.name = "exact", .cases = 5000});
  EXPECT_TRUE(report.clean()) << report;
  EXPECT_EQ(report.counts().queries, 5000U);
  EXPECT_TRUE(report.findings().empty());
  const auto within =
      nearmiss::trial(exact, {.name = "exact", .separation = "drawn", .kinds = 15, .cases = 5000});
  EXPECT_TRUE(within.clean()) << within;
  EXPECT_GT(within.counts(nearmiss::Kind::vertex_edge).queries, 0U);
}

TEST(MyCcd, ThreadsAndBatchesGiveTheSameCounts) {
  const auto one = nearmiss::trial(mine, {.seed = 7, .cases = 5000});
  const auto four = nearmiss::trial(mine, {.seed = 7, .cases = 5000, .threads = 4});
  EXPECT_EQ(one.text(), four.text());
  std::atomic<std::size_t> largest = 0;
  const auto batched = nearmiss::trial(
      [&](std::span<const nearmiss::Question> q, std::span<nearmiss::plugin::Answer> answers) {
        largest = std::max(largest.load(), q.size());
        for (std::size_t i = 0; i < q.size(); ++i) answers[i] = nearmiss::ask(mine, q[i]);
      },
      {.name = "mine", .kinds = NEARMISS_VERTEX_TRIANGLE, .seed = 7, .cases = 5000});
  EXPECT_EQ(one.text(), batched.text());
  EXPECT_GT(largest, 1U);
}

TEST(MyCcd, AnExceptionIsAFaultOfItsQuery) {
  const auto report = nearmiss::trial(
      [](const nearmiss::Question& q) {
        if (q.x[0] > 0) throw std::runtime_error("not on my watch");
        return exact(q);
      },
      {.cases = 2000});
  EXPECT_FALSE(report.clean());
  EXPECT_GT(report.counts().no_answer, 0U);
  EXPECT_LT(report.counts().no_answer, 2000U);
  EXPECT_EQ(report.counts().missed, 0U);
  EXPECT_NE(report.text().find("not on my watch"), std::string::npos) << report;
}

TEST(MyCcd, TimesAreLowerBoundsIfItSaysSo) {
  const auto late = [](const nearmiss::Question& q) { return exact(q) ? std::optional(1.0) : std::nullopt; };
  EXPECT_TRUE(nearmiss::trial(late, {.cases = 2000}).clean());
  const auto report = nearmiss::trial(late, {.cases = 2000, .time_sort = NEARMISS_TIME_LOWER_BOUND});
  EXPECT_GT(report.counts().late, 0U);
  EXPECT_NE(report.text().find(".time <= "), std::string::npos) << report;
}

TEST(MyCcd, OptionsThatMakeNoSenseAreRefused) {
  EXPECT_THROW(nearmiss::trial(mine, {.families = "uniforms"}), std::invalid_argument);
  EXPECT_THROW(nearmiss::trial(mine, {.cases = 0}), std::invalid_argument);
  EXPECT_THROW(nearmiss::trial(mine, {.kinds = NEARMISS_EDGE_EDGE}), std::invalid_argument);
  EXPECT_THROW(nearmiss::trial(mine, {.separation = "-1"}), std::invalid_argument);
  EXPECT_THROW(nearmiss::hard_queries("uniforms", nearmiss::Kind::edge_edge, 1, 10), std::invalid_argument);
}

TEST(MyCcd, HardQueriesForLoopsOfOnesOwn) {
  const auto queries = nearmiss::hard_queries("planted", nearmiss::Kind::edge_edge, 1, 200);
  ASSERT_EQ(queries.size(), 200U);
  for (std::size_t i = 0; i < queries.size(); ++i) EXPECT_TRUE(exact(queries[i])) << i;  // planted collisions
}

}  // namespace
