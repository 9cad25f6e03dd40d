// Tests what the functions of oracle/interface refuse, and what they leave unchanged. tests/installed
// compares the answers of an installed library with those of this source tree.
#include "oracle/interface/nearmiss.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "ccd/nearmiss_subject.h"
#include "tests/random_queries.hpp"

namespace nearmiss {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A vertex that falls through a triangle at t = 1/2.
constexpr std::array<double, 24> falling{0.25, 0.25, 1,  0, 0, 0, 1, 0, 0, 0, 1, 0,
                                         0.25, 0.25, -1, 0, 0, 0, 1, 0, 0, 0, 1, 0};

TEST(Interface, SaysWhichQueriesAreNotFinite) {
  // Asks one query, a few queries, and several blocks of queries.
  for (const std::size_t count : {1U, 3U, 7U, 300U})
    for (const auto& [odd, place, is_far] :
         std::vector<std::tuple<double, std::size_t, bool>>{{infinity, 23, false},
                                                            {-infinity, 0, false},
                                                            {nan, 12, false},
                                                            {nan, 0, true},
                                                            {infinity, 21, true}}) {
      std::vector<double> x;
      for (std::size_t q = 0; q < count; ++q) x.insert(x.end(), falling.begin(), falling.end());
      if (is_far) x[24 * (count - 1) + 14] = 9;  // the primitives' boxes do not meet
      x[24 * (count - 1) + place] = odd;
      const Queries queries = Queries::packed(Kind::vertex_triangle, x);
      std::vector<std::int8_t> answers(count), expected(count, NEARMISS_COLLISION);
      expected.back() = NEARMISS_NO_ANSWER;
      EXPECT_EQ(collides(queries, answers), Status::not_finite);
      EXPECT_EQ(answers, expected);
      EXPECT_EQ(wang(queries, answers), Status::not_finite);
      EXPECT_EQ(answers, expected);
      std::vector<double> lo(count), hi(count);
      EXPECT_EQ(earliest_times(queries, lo, hi), Status::not_finite);
      EXPECT_TRUE(std::isnan(lo.back()) && std::isnan(hi.back()));
      EXPECT_EQ(smallest_distances(queries, lo), Status::not_finite);
      EXPECT_TRUE(std::isnan(lo.back()));
      EXPECT_EQ(wang_bounds(queries, lo), Status::not_finite);
      EXPECT_TRUE(std::isnan(lo.back()));
      EXPECT_EQ(times_of_impact(queries, answers, lo), Status::not_finite);
      EXPECT_EQ(answers, expected);
      EXPECT_EQ(lo.back(), 0);
    }
}

TEST(Interface, RefusesSeparationsThatAreNone) {
  for (const double h : {-1.0, nan, infinity, -std::numeric_limits<double>::denorm_min()}) {
    EXPECT_EQ(collides(Kind::vertex_triangle, falling, h), Answer::none) << h;
    EXPECT_TRUE(std::isnan(earliest_time(Kind::vertex_triangle, falling, h).lo)) << h;
  }
  EXPECT_EQ(collides(Kind::vertex_triangle, falling, -0.0), Answer::collision);
  std::int8_t answer = 7;
  const double h = 1;
  EXPECT_EQ(wang(Queries::packed(Kind::vertex_triangle, falling).with_separation(h), {&answer, 1}),
            Status::bad_argument);
  EXPECT_EQ(answer, 7);
}

TEST(Interface, EachQueryMayHaveItsOwnSeparation) {
  std::vector<double> x(falling.begin(), falling.end());
  x[14] = 0.5;  // the vertex stops at a distance of 1/2
  x.insert(x.end(), x.begin(), x.end());
  x.insert(x.end(), x.begin(), x.end());
  const std::array h{0.0, 0.25, 0.5, 0.75};
  const Queries queries = Queries::packed(Kind::vertex_triangle, x).with_separations(h);
  std::array<std::int8_t, 4> answers{};
  EXPECT_EQ(collides(queries, answers), Status::ok);
  EXPECT_THAT(answers, ElementsAre(0, 0, 1, 1));
  std::array<double, 4> toi{};
  EXPECT_EQ(times_of_impact(queries, answers, toi), Status::ok);
  EXPECT_THAT(toi, ElementsAre(infinity, infinity, 1, 0.5));
  EXPECT_EQ(times_of_impact(queries, answers, toi, 0.75), Status::ok);
  EXPECT_THAT(answers, ElementsAre(0, 0, 0, 1));
}

TEST(Interface, EverySpanHasOneElementForEachQuery) {
  std::vector<double> x(falling.begin(), falling.end());
  x.insert(x.end(), falling.begin(), falling.end());
  const Queries queries = Queries::packed(Kind::vertex_triangle, x);
  const std::vector<double> h(3);
  std::vector<std::int8_t> answers(2, 7);
  for (const std::size_t size : {0U, 1U, 3U}) {
    const Queries of_others = queries.with_separations(std::span(h).first(size));
    EXPECT_EQ(collides(of_others, answers), Status::bad_argument) << size;
    EXPECT_EQ(collides(of_others.with_separation(h[0]), answers), Status::ok);
    answers.assign(2, 7);
  }
  EXPECT_EQ(collides(queries, std::span(answers).first(1)), Status::bad_argument);
  EXPECT_THAT(answers, ElementsAre(7, 7));
}

/// Two edges are farther apart than the largest double, and one end of an edge moves by 1.
TEST(Interface, TheBoundOfWangIsThatOfThePairHoweverFarItsPrimitivesAreApart) {
  constexpr double a = 0x1.8p+1023;
  constexpr double b = 0x1p+1023;
  constexpr std::array far_apart{-a, a, 0.0, -a, a, 0.0, b, -a, 0.0,  b, -a, 0.0,
                                 -a, a, 0.0, -a, a, 0.0, b, -a, -1.0, b, -a, 0.0};
  auto near = far_apart;
  for (std::size_t i = 0; i < near.size(); ++i)
    if (i % 3 != 2) near[i] = 0;
  EXPECT_GT(wang_bound(Kind::edge_edge, near), 0);
  EXPECT_EQ(wang_bound(Kind::edge_edge, far_apart), wang_bound(Kind::edge_edge, near));
  EXPECT_EQ(wang(Kind::edge_edge, far_apart), Answer::no_collision);
}

TEST(Interface, DistancesIgnoreSeparations) {
  for (const double h : {-1.0, nan, infinity, 0.5}) {
    double lo = 7;
    const Queries query = Queries::packed(Kind::vertex_triangle, falling).with_separation(h);
    EXPECT_EQ(smallest_distances(query, {&lo, 1}), Status::ok) << h;
    EXPECT_EQ(lo, 0) << h;
  }
}

TEST(Interface, SeparationsOfZeroAskForContact) {
  constexpr std::size_t count = 300;  // more than a block
  std::vector<double> x;
  for (std::size_t q = 0; q < count; ++q) x.insert(x.end(), falling.begin(), falling.end());
  x[14] = 0.5;                     // the vertex of the first query stops at a distance of 1/2
  x[24 * (count - 1) + 14] = 0.5;  // and so does the vertex of the last query
  std::vector<double> h(count);
  const Queries queries = Queries::packed(Kind::vertex_triangle, x).with_separations(h);
  std::vector<std::int8_t> expected(count, 1);
  expected.front() = expected.back() = 0;
  std::vector<std::int8_t> answers(count);
  EXPECT_EQ(collides(queries, answers), Status::ok);
  EXPECT_EQ(answers, expected);
  answers.clear();
  answers.resize(count);
  EXPECT_EQ(wang(queries, answers), Status::ok);
  EXPECT_EQ(answers, expected);
  h.back() = 0.5;
  expected.back() = 1;
  EXPECT_EQ(collides(queries, answers), Status::ok);
  EXPECT_EQ(answers, expected);
  EXPECT_EQ(wang(queries, answers), Status::bad_argument);
}

TEST(Interface, RefusesArgumentsAndWritesNothing) {
  nearmiss_queries queries = nearmiss_packed(NEARMISS_EDGE_EDGE, 1, falling.data());
  std::int8_t answer = 7;
  double number = 7;
  const auto expect_refused = [&] {
    EXPECT_EQ(nearmiss_collides(&queries, &answer, nullptr), NEARMISS_BAD_ARGUMENT);
    EXPECT_EQ(nearmiss_wang(&queries, &answer), NEARMISS_BAD_ARGUMENT);
    EXPECT_EQ(nearmiss_wang_bound(&queries, &number), NEARMISS_BAD_ARGUMENT);
    EXPECT_EQ(nearmiss_earliest_time(&queries, 0, &number, nullptr), NEARMISS_BAD_ARGUMENT);
    EXPECT_EQ(nearmiss_time_of_impact(&queries, 1, &answer, &number), NEARMISS_BAD_ARGUMENT);
    EXPECT_EQ(nearmiss_smallest_distance(&queries, 0.1, &number, nullptr), NEARMISS_BAD_ARGUMENT);
    EXPECT_EQ(answer, 7);
    EXPECT_EQ(number, 7);
  };
  for (const int kind : {0, 3, -1}) {
    queries.kind = kind;
    expect_refused();
  }
  queries.kind = NEARMISS_EDGE_EDGE;
  queries.type = 2;
  expect_refused();
  queries.type = NEARMISS_DOUBLE;
  queries.end = nullptr;
  expect_refused();
  queries = nearmiss_packed(NEARMISS_EDGE_EDGE, 1, nullptr);
  expect_refused();
  queries = nearmiss_packed(NEARMISS_EDGE_EDGE, 1, falling.data());
  EXPECT_EQ(nearmiss_collides(&queries, nullptr, nullptr), NEARMISS_BAD_ARGUMENT);
  for (const double width : {-1.0, nan}) {
    EXPECT_EQ(nearmiss_earliest_time(&queries, width, &number, nullptr), NEARMISS_BAD_ARGUMENT);
    EXPECT_EQ(nearmiss_smallest_distance(&queries, width, &number, nullptr), NEARMISS_BAD_ARGUMENT);
  }
  for (const double tmax : {1.5, nan})
    EXPECT_EQ(nearmiss_time_of_impact(&queries, tmax, &answer, &number), NEARMISS_BAD_ARGUMENT);
  EXPECT_EQ(answer, 7);
  EXPECT_EQ(number, 7);
}

TEST(Interface, RefusesALayoutThatIsMissing) {
  std::int8_t answer = 7;
  double number = 7;
  EXPECT_EQ(nearmiss_collides(nullptr, &answer, nullptr), NEARMISS_BAD_ARGUMENT);
  EXPECT_EQ(nearmiss_wang_bound(nullptr, &number), NEARMISS_BAD_ARGUMENT);
  EXPECT_EQ(nearmiss_earliest_time(nullptr, 0, &number, nullptr), NEARMISS_BAD_ARGUMENT);
  EXPECT_EQ(answer, 7);
  EXPECT_EQ(number, 7);
}

TEST(Interface, EarliestTimesLieBetweenTheirSpans) {
  std::array<double, 24> x = falling;
  x[14] = -2;  // the vertex falls through the triangle at t = 1/3
  std::array<double, 1> lo{}, hi{};
  EXPECT_EQ(earliest_times(Queries::packed(Kind::vertex_triangle, x), lo, hi), Status::ok);
  EXPECT_EQ(lo[0], 1. / 3);  // rounded down
  EXPECT_EQ(hi[0], std::nextafter(1. / 3, 1));
}

TEST(Interface, TheTimesOfManyQueriesAreThoseOfEach) {
  std::vector<double> x;
  for (std::size_t q = 0; q < 300; ++q) {
    Random random(31, 0, q);
    const Query query = testing::uniform_query(random, Kind::edge_edge);
    x.insert(x.end(), query.x.begin(), query.x.end());
  }
  const Queries all = Queries::packed(Kind::edge_edge, x);
  std::vector<double> lo(300), hi(300), toi(300);
  std::vector<std::int8_t> answers(300);
  EXPECT_EQ(earliest_times(all, lo, hi), Status::ok);
  EXPECT_EQ(times_of_impact(all, answers, toi), Status::ok);
  EXPECT_EQ(toi, lo);
  std::size_t collisions = 0;
  for (std::size_t q = 0; q < 300; ++q) {
    const Interval one = earliest_time(Kind::edge_edge, Coordinates(&x[24 * q], 24));
    EXPECT_EQ(std::pair(lo[q], hi[q]), std::pair(one.lo, one.hi)) << q;
    collisions += answers[q] == NEARMISS_COLLISION ? 1 : 0;
  }
  EXPECT_GT(collisions, 30);
}

TEST(Interface, AnswersNoQueriesAtAll) {
  const Queries none = Queries::packed(Kind::edge_edge, std::span<const double>());
  EXPECT_EQ(none.size(), 0);
  EXPECT_EQ(collides(none, {}), Status::ok);
  EXPECT_EQ(wang_bounds(none, {}), Status::ok);
  std::int8_t answer = 7;
  EXPECT_EQ(collides(none, {&answer, 1}), Status::bad_argument);
  EXPECT_EQ(nearmiss_collides(&none.layout(), &answer, nullptr), NEARMISS_OK);
  EXPECT_EQ(answer, 7);
}

TEST(Interface, TheSmallestDistanceIsAsNarrowAsAsked) {
  std::array<double, 24> x = falling;
  x[12] = 0.7;
  x[14] = 1. / 3;  // the vertex ends above the triangle
  for (const double width : {0.5, 1e-3, 1e-9, 1e-15, 0.0, 1e300}) {
    const Interval distance = smallest_distance(Kind::vertex_triangle, x, width);
    EXPECT_LE(distance.lo, 1. / 3);
    EXPECT_GE(distance.hi, 1. / 3);
    EXPECT_LE(distance.hi - distance.lo, std::max(width, 1e-15) * distance.hi) << width;
  }
}

TEST(Interface, VerticesAndTheStrideOfQueriesAreAddedUp) {
  const std::vector<std::int32_t> vertices{0, 1, 2, 3, 3, 2, 1, 0};
  std::vector<double> x(falling.begin(), falling.end());
  for (const std::size_t vertex : {3U, 2U, 1U, 0U})  // the second query at t = 0, in reverse order
    x.insert(x.end(), &falling[3 * vertex], &falling[3 * vertex] + 3);
  for (const std::size_t vertex : {3U, 2U, 1U, 0U})
    x.insert(x.end(), &falling[12 + 3 * vertex], &falling[12 + 3 * vertex] + 3);
  nearmiss_queries queries = nearmiss_packed(NEARMISS_VERTEX_TRIANGLE, 2, x.data());
  queries.vertices = vertices.data();
  std::array<std::int8_t, 2> answers{};
  std::array<double, 2> toi{};
  EXPECT_EQ(nearmiss_time_of_impact(&queries, 1, answers.data(), toi.data()), NEARMISS_OK);
  EXPECT_THAT(toi, Each(0.5));
}

/// A vertex that passes the vertex (1, 0, 0) and the edge (1, 0, 0) (1, 1, 0), both at a distance of 1/2.
constexpr std::array<double, 18> passing{0, 0, 0.5, 1, 0, 0, 1, 1, 0,  //
                                         2, 0, 0.5, 1, 0, 0, 1, 1, 0};

TEST(Interface, DecidesVerticesAndEdges) {
  std::array<double, 12> of_vertices{};
  std::copy_n(passing.begin(), 6, of_vertices.begin());
  std::copy_n(passing.begin() + 9, 6, of_vertices.begin() + 6);
  const std::vector<std::int32_t> numbers{0, 1, 2};
  const auto expect_answers = [](const Queries& queries) {
    std::array<std::int8_t, 1> answer{};
    for (const double h : {0.5, 0.25}) {
      EXPECT_EQ(collides(queries.with_separation(h), answer), Status::ok);
      EXPECT_EQ(answer[0], h == 0.5 ? 1 : 0) << h;
      EXPECT_EQ(wang(queries.with_separation(h), answer), Status::ok);
      if (h == 0.5) {
        EXPECT_EQ(answer[0], 1);
      }
    }
    std::array<double, 1> lo{}, hi{};
    EXPECT_EQ(smallest_distances(queries, lo, hi), Status::ok);
    EXPECT_LE(lo[0], 0.5);
    EXPECT_GE(hi[0], 0.5);
    EXPECT_EQ(wang_bounds(queries, lo), Status::ok);
    EXPECT_GT(lo[0], 0);
  };
  expect_answers(Queries::packed(Kind::vertex_vertex, of_vertices));
  expect_answers(Queries::packed(Kind::vertex_edge, passing));
  expect_answers(Queries::of_mesh(Kind::vertex_edge, numbers, passing.data(), passing.data() + 9));
  const std::vector<float> small(passing.begin(), passing.end());
  expect_answers(Queries::packed(Kind::vertex_edge, small));
  EXPECT_EQ(Queries::packed(Kind::vertex_vertex, passing).size(), 1);
  EXPECT_EQ(collides(Kind::vertex_vertex, of_vertices, 0.5), Answer::collision);
  EXPECT_EQ(collides(Kind::vertex_triangle, passing, 0.5), Answer::none);
}

TEST(Interface, EveryStatusHasAMessageOfItsOwn) {
  std::vector<std::string> messages;
  for (int status = -1; status < 4; ++status) messages.emplace_back(nearmiss_message(status));
  EXPECT_THAT(messages, Each(::testing::Not("")));
  EXPECT_EQ(std::set<std::string>(messages.begin(), messages.end()).size(), messages.size());
}

}  // namespace
}  // namespace nearmiss
