// The subjects wang-time and advance give lower bounds of the time. Tests these bounds on queries whose times
// are known.
#include "ccd/wang/wang_time.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "ccd/subjects/subject.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using testing::falling_edge;
using testing::falling_vertex;
using testing::make_query;
using testing::scaled;

Verdict decide(const Query& query) { return make_subject("wang-time")->decide(query); }

void expect_just_before(const Query& query, double time) {
  const Verdict verdict = decide(query);
  EXPECT_TRUE(verdict.hit);
  EXPECT_LE(verdict.time, time);
  EXPECT_GE(verdict.time, time - 1e-10);
}

/// The subjects whose times are lower bounds of t*, each with a limit on how much earlier than t* its times
/// may be.
constexpr std::pair<const char*, double> lower_bounds[]{{"advance", 1e-12}, {"wang-time", 1e-10}};

TEST(LowerBounds, AreJustBeforeContact) {
  for (const auto& [name, early] : lower_bounds)
    for (const auto& [query, time] : {std::pair(falling_vertex(0.25, 0.25, 1, -1), 0.5),
                                      {falling_vertex(0.25, 0.25, 1, 0), 1},
                                      {falling_vertex(0, 0, 3, -1), 0.75},
                                      {falling_edge(1, -3), 0.25}}) {
      const Verdict verdict = make_subject(name)->decide(query);
      EXPECT_TRUE(verdict.hit) << name;
      EXPECT_LE(verdict.time, time) << name;
      EXPECT_GE(verdict.time, time - early) << name;
    }
}

TEST(LowerBounds, AreZeroForContactAtTheStart) {
  for (const auto& [name, early] : lower_bounds)
    for (const Query& query : {falling_vertex(0.25, 0.25, 0, 1), falling_edge(0, 1),
                               Query{.kind = Kind::vertex_triangle}, Query{.kind = Kind::edge_edge}})
      EXPECT_EQ(make_subject(name)->decide(query).time, 0) << name;
}

TEST(LowerBounds, DoNotDependOnTheUnitOfLength) {
  for (const auto& [name, early] : lower_bounds) {
    const auto subject = make_subject(name);
    for (const Query& query : {falling_vertex(0.3, 0.1, 0.7, -1.1), falling_edge(0.7, -1.1)}) {
      const double h = subject->takes_separation(query.kind) ? 0.1 : 0;
      const double time = subject->decide(with_separation(query, h)).time;
      EXPECT_GT(time, 0) << name;
      for (const double factor : {0x1p-1000, 0x1p-90, 0x1p90, 0x1p1020})
        EXPECT_EQ(subject->decide(with_separation(scaled(query, factor), h * factor)).time, time)
            << name << factor;
    }
  }
}

TEST(WangTime, IsThatOfAPlaneForMotionInOnePlane) {
  const Vector3<double> o(0, 0, 0), a(1, 0, 0), b(0, 1, 0);
  expect_just_before(make_query(Kind::vertex_triangle, {{-1, 0.25, 0}, o, a, b}, {{1, 0.25, 0}, o, a, b}),
                     0.5);
  expect_just_before(make_query(Kind::vertex_triangle, {{1, 1, 0}, o, a, b}, {{0, 0, 0}, o, a, b}), 0.5);
  const Vector3<double> c(0, -1, 0);
  expect_just_before(
      make_query(Kind::edge_edge, {{2, 0, 0}, {3, 0, 0}, b, c}, {{-2, 0, 0}, {-1, 0, 0}, b, c}), 0.5);
}

// No axis and no diagonal is a normal of the edge from (1, 0, 0) to (0, 3, 0).
TEST(WangTime, IsZeroIfNoPlaneSeparatesMotionInOnePlane) {
  const Vector3<double> o(0, 0, 0), a(1, 0, 0), b(0, 3, 0);
  const Query query = make_query(Kind::vertex_triangle, {{0.6, 1.5, 0}, o, a, b}, {{0, 0, 0}, o, a, b});
  EXPECT_TRUE(decide(query).hit);
  EXPECT_EQ(decide(query).time, 0);
}

// The plane of the triangle is z = t y. At t = 1/4, the vertex is in this plane beside the triangle; at t =
// 3/4, it is inside the triangle.
TEST(WangTime, LeavesOutARootThatIsNoContact) {
  const Vector3<double> o(0, 0, 0), a(1, 0, 0);
  const Query query = make_query(Kind::vertex_triangle, {{0.875, 1.5, 0.1875}, o, a, {0, 3, 0}},
                                 {{-0.025, 0.5, 0.6875}, o, a, {0, 3, 3}});
  EXPECT_LT((detail::separated_until(make_pair<Kind::vertex_triangle, double>(query))), 0.25);
  expect_just_before(query, 0.75);
}

TEST(WangTime, DoesNotDependOnAGivenBound) {
  const Query query = falling_vertex(0.3, 0.1, 0.7, -1.1);
  EXPECT_EQ(make_subject("wang-time@1e3")->decide(query).time, decide(query).time);
}

// wang-time reports the pair only because the caller gives a large bound on all lengths, B = 1e6. The pair
// has no contact, so 1 is a lower bound of the time.
TEST(WangTime, IsOneWithoutContact) {
  const Query query = falling_vertex(0.25, 0.25, 2, 1);
  const Verdict verdict =
      wang_time<Kind::vertex_triangle, double, WangOptions{false, VeCulling::none}>(query, 1e6);
  EXPECT_TRUE(verdict.hit);
  EXPECT_EQ(verdict.time, 1);
}

}  // namespace
}  // namespace nearmiss
