// A trial as a test of GoogleTest.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <nearmiss/nearmiss.hpp>
#include <nearmiss/trial.hpp>
#include <sstream>
#include <stdexcept>
#include <string>

#include "my_ccd.hpp"

namespace {

bool exact(const nearmiss::Question& q) {
  const nearmiss::Kind kind = *nearmiss::kind_of_bit(q.kind);
  std::int8_t answer = -1;
  const auto queries = nearmiss::Queries::packed(kind, std::span(q.x, nearmiss::coordinate_count(kind)));
  nearmiss::collides(queries.with_separation(q.separation), std::span(&answer, 1));
  return answer == NEARMISS_COLLISION;
}

const auto mine = nearmiss::plugin::detector("mine").vertex_triangle(user::point_triangle_ccd);

TEST(MyCcd, ABugIsFoundAndShownByAnOrdinaryQuery) {
  const auto report = nearmiss::trial(mine);
  ASSERT_FALSE(report.clean()) << report;
  EXPECT_GT(report.counts(nearmiss::Kind::vertex_triangle).missed, 0U);
  EXPECT_EQ(report.counts(nearmiss::Kind::edge_edge).queries, 0U);
  ASSERT_FALSE(report.findings().empty());
  const nearmiss_trial_finding& first = report.findings().front();
  EXPECT_STREQ(first.what, "false-negative");
  EXPECT_STREQ(first.query_class, "ordinary");
  EXPECT_FALSE(nearmiss::ask(mine, {first.kind, first.x, first.separation}));
  EXPECT_TRUE(exact({first.kind, first.x, first.separation}));
  EXPECT_NE(report.text().find("EXPECT_TRUE(nearmiss::ask(mine, {NEARMISS_VERTEX_TRIANGLE, x, 0}))"),
            std::string_view::npos)
      << report;
}

TEST(MyCcd, ARightOnePasses) {
  const auto report = nearmiss::trial(exact, {.name = "exact", .cases = 2000});
  EXPECT_TRUE(report.clean()) << report;
  EXPECT_EQ(report.counts().queries, 2000U);
  EXPECT_TRUE(report.findings().empty());
  const auto within =
      nearmiss::trial(exact, {.name = "exact", .separation = "drawn", .kinds = 15, .cases = 2000});
  EXPECT_TRUE(within.clean()) << within;
  EXPECT_GT(within.counts(nearmiss::Kind::vertex_edge).queries, 0U);
}

TEST(MyCcd, ThreadsAndBatchesGiveTheSameCounts) {
  const auto one = nearmiss::trial(mine, {.seed = 7, .cases = 2000});
  const auto four = nearmiss::trial(mine, {.seed = 7, .cases = 2000, .threads = 4});
  EXPECT_EQ(one.text(), four.text());
  std::atomic<std::size_t> largest = 0;
  const auto batched = nearmiss::trial(
      [&](std::span<const nearmiss::Question> q, std::span<nearmiss::plugin::Answer> answers) {
        largest = std::max(largest.load(), q.size());
        for (std::size_t i = 0; i < q.size(); ++i) answers[i] = nearmiss::ask(mine, q[i]);
      },
      {.name = "mine", .kinds = NEARMISS_VERTEX_TRIANGLE, .seed = 7, .cases = 2000});
  EXPECT_EQ(one.text(), batched.text());
  EXPECT_GT(largest, 1U);
}

TEST(MyCcd, AnExceptionIsAFaultOfItsQuery) {
  const auto report = nearmiss::trial(
      [](const nearmiss::Question& q) {
        if (q.x[0] > 0) throw std::runtime_error("not on my watch");
        return exact(q);
      },
      {.cases = 1000});
  EXPECT_FALSE(report.clean());
  EXPECT_GT(report.counts().no_answer, 0U);
  EXPECT_LT(report.counts().no_answer, 1000U);
  EXPECT_EQ(report.counts().missed, 0U);
  EXPECT_NE(report.text().find("not on my"), std::string::npos) << report;
}

/// Expects that the text of a report has at most 15 lines, of at most 79 columns each.
void expect_short(const nearmiss::TrialReport& report) {
  std::istringstream lines{std::string(report.text())};
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_LE(line.size(), 79U) << report;
  EXPECT_LE(count, 15) << report;
}

TEST(MyCcd, TextsAreShortWhateverFails) {
  expect_short(nearmiss::trial(mine));
  const auto loud = [](const nearmiss::Question& q) -> std::optional<double> {
    if (q.x[1] > 0.5) throw std::runtime_error(std::string(300, 'x') + "\nsecond\x1b[31m line");
    return q.x[2] > 0 ? std::optional(1.0) : std::nullopt;
  };
  for (const char* families : {"all", "decimals", "near-underflow", "v-uniform"}) {
    const auto report = nearmiss::trial(
        loud, {.families = families, .kinds = 15, .cases = 500, .time_sort = NEARMISS_TIME_LOWER_BOUND});
    EXPECT_FALSE(report.clean());
    expect_short(report);
    EXPECT_EQ(report.text().find('\x1b'), std::string_view::npos);
  }
}

TEST(MyCcd, OfAnyFormMayPromiseLowerBounds) {
  const nearmiss::TrialOptions promises{.cases = 500, .time_sort = NEARMISS_TIME_LOWER_BOUND};
  const auto answer = [](const nearmiss::Question& q) {
    return exact(q) ? nearmiss::plugin::Answer::of(true, 1) : nearmiss::plugin::Answer();
  };
  const auto time = [](const nearmiss::Question& q) { return exact(q) ? std::optional(1.0F) : std::nullopt; };
  const auto batch = [&](std::span<const nearmiss::Question> q, std::span<nearmiss::plugin::Answer> answers) {
    for (std::size_t i = 0; i < q.size(); ++i) answers[i] = answer(q[i]);
  };
  for (const auto& report : {nearmiss::trial(answer, promises), nearmiss::trial(time, promises),
                             nearmiss::trial(batch, promises)}) {
    EXPECT_GT(report.counts().late, 0U);
    EXPECT_NE(report.text().find(".time <="), std::string_view::npos) << report;
  }
  EXPECT_TRUE(nearmiss::trial(answer, {.cases = 500}).clean());
  EXPECT_THROW(nearmiss::trial(exact, promises), std::invalid_argument);  // `exact` gives no times
}

TEST(MyCcd, FaultsAndUnsafeStepsHaveExamplesThatFail) {
  const auto nonsense = [](const nearmiss::Question& q) {
    return nearmiss::plugin::Answer{exact(q) ? 7 : 0, 0};
  };
  const auto faults = nearmiss::trial(nonsense, {.cases = 500});
  EXPECT_NE(faults.text().find("EXPECT_TRUE(nearmiss::answers(my_ccd, {NEARMISS_"), std::string_view::npos)
      << faults;
  const auto late = [](const nearmiss::Question& q) { return exact(q) ? std::optional(2.0) : std::nullopt; };
  const auto result = nearmiss::trial(late, {.cases = 500});
  for (const auto& each : result.findings())
    EXPECT_FALSE(nearmiss::answers(late, {each.kind, each.x, each.separation}));
  for (const auto& each : faults.findings()) {
    EXPECT_STREQ(each.what, "fault");
    EXPECT_FALSE(nearmiss::answers(nonsense, {each.kind, each.x, each.separation}));
    EXPECT_TRUE(nearmiss::answers(exact, {each.kind, each.x, each.separation}));
  }
}

TEST(MyCcd, ABoundAndExceptionsTogetherGiveAReport) {
  const auto f = [](const nearmiss::Question& q) {
    if (q.x[3] > 0.9) throw std::runtime_error("x");
    return nearmiss::plugin::Answer::of(true);
  };
  const auto both = nearmiss::plugin::detector("both").vertex_triangle(f).edge_edge(f).set(
      &nearmiss_subject::distance_bound, +[](void*, int, const double*) { return 0.0; });
  const auto report = nearmiss::trial(both, {.cases = 3000});
  EXPECT_GT(report.counts().no_answer, 0U);
  EXPECT_GT(report.counts().beyond_bound, 0U);
}

TEST(MyCcd, FamiliesMayBeGroupsWithBlanks) {
  const auto report = nearmiss::trial(exact, {.families = "uniform, vertices,", .kinds = 15, .cases = 1000});
  EXPECT_TRUE(report.clean());
  EXPECT_GT(report.counts(nearmiss::Kind::vertex_vertex).queries, 0U);
  // In a detector, too, a function that takes a Question may return a bool.
  EXPECT_TRUE(nearmiss::trial(nearmiss::plugin::detector("d").edge_edge(exact), {.cases = 500}).clean());
}

TEST(MyCcd, OptionsThatMakeNoSenseAreRefused) {
  for (const nearmiss::TrialOptions& bad :
       {nearmiss::TrialOptions{.families = "uniforms"}, nearmiss::TrialOptions{.cases = 0},
        nearmiss::TrialOptions{.kinds = NEARMISS_EDGE_EDGE}, nearmiss::TrialOptions{.separation = "-1"},
        nearmiss::TrialOptions{.time = std::chrono::seconds(-1)}})
    EXPECT_THROW(nearmiss::trial(mine, bad), std::invalid_argument);
  EXPECT_THROW(nearmiss::hard_queries("uniforms", nearmiss::Kind::edge_edge, 1, 10), std::invalid_argument);
  // The report of a trial that asked its CCD no query is not clean.
  EXPECT_FALSE(nearmiss::trial(exact, {.time = std::chrono::nanoseconds(1)}).clean());
}

TEST(MyCcd, HardQueriesForLoopsOfOnesOwn) {
  const auto queries = nearmiss::hard_queries("planted", nearmiss::Kind::edge_edge, 1, 200);
  ASSERT_EQ(queries.size(), 200U);
  for (std::size_t i = 0; i < queries.size(); ++i) EXPECT_TRUE(exact(queries[i])) << i;  // planted collisions
}

}  // namespace
