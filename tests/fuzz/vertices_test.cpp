// wang on two vertices, and on a vertex and an edge: it reports everything within h, and nothing beyond its
// bound.
#include <CGAL/Interval_nt.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "ccd/wang/bounds/tight_tolerances.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"
#include "tests/fuzz/family_queries.hpp"
#include "tests/refused.hpp"

namespace nearmiss {
namespace {

using Interval = CGAL::Interval_nt<>;

class VertexFamilies : public ::testing::TestWithParam<Family> {};
INSTANTIATE_TEST_SUITE_P(All, VertexFamilies,
                         ::testing::ValuesIn(vertex_families().begin(), vertex_families().end()),
                         testing::name_of_test);

TEST_P(VertexFamilies, NothingWithinHIsMissedAndNothingBeyondTheBoundReported) {
  const Family family = testing::as_asked(GetParam());
  const std::uint64_t count = testing::query_count(GetParam().block_cases < 25 ? 100 : 1000);
  for (const char* name : {"wang", "wang-plain", "wang-tight"}) {
    const auto subject = make_subject(name);
    for (std::uint64_t i = 0; i < count; ++i) {
      const Query query = make_query(family, 5, i);
      const bool hit = subject->decide(query).hit;
      if (decide(query).collision) {
        EXPECT_TRUE(hit) << name << ' ' << i;
      } else if (hit) {
        EXPECT_FALSE(distance_exceeds_separation_by(query, subject->distance_bound(query)))
            << name << ' ' << i;
      }
    }
  }
}

/// A number that was computed, divided by a power of B.
Interval enclosure(double x) { return {std::nextafter(x, -HUGE_VAL), std::nextafter(x, HUGE_VAL)}; }

/// The constraints on the tests of two vertices, or of a vertex and an edge, for tolerances that were computed
/// for B.
void expect_constraints(const Tolerances<double>& computed, double B, bool of_edge) {
  const Interval b(B);
  Tolerances<Interval> tol;
  tol.delta = enclosure(computed.delta) / b / b;
  tol.D2 = enclosure(computed.D2) / b / b;
  tol.rho = enclosure(computed.rho) / b / b;
  tol.psi = enclosure(computed.psi) / b / b;
  tol.lambda2 = enclosure(computed.lambda2) / b / b;
  tol.S = enclosure(computed.S) / b;
  tol.mu = tol.tau = tol.eta = 1;  // they have no influence on these constraints
  const auto errors = full_errors(Interval(epsilon<double>()), tol.S, tol.rho);
  for (const auto& each : constraints(tol, Interval(1), Interval(1), errors))
    if (each.about == "VV" || (of_edge && each.about.starts_with("VE"))) {
      EXPECT_GE(each.more.inf(), each.less.sup()) << each.about << ", R = " << computed.R << ", B = " << B;
    }
}

/// Calls check(R) for many R from 0 to 4 B. Two primitives with a larger R are always within R.
template <class Check>
void for_each_R(double B, const Check& check) {
  check(0);
  for (int exponent = -1000; exponent < -60; exponent += 100) check(std::ldexp(B, exponent));
  for (int sixteenth = -60 * 16; sixteenth <= 2 * 16; ++sixteenth) check(B * std::exp2(sixteenth / 16.0));
}

template <class Rule>
void expect_constraints_of_rule() {
  const Rule rule;
  for (const double B : {1.0, 1.3, 1.9, 0.7})
    for_each_R(B, [&](double R) {
      expect_constraints(rule.of_edge(B, R), B, true);
      expect_constraints(rule.of_vertices(B, R), B, false);
    });
}

// In interval arithmetic, as they are computed.
TEST(TolerancesOfVertices, SatisfyTheConstraintsForEveryR) {
  const CGAL::Protect_FPU_rounding<true> upwards;
  expect_constraints_of_rule<PaperTolerances>();
  expect_constraints_of_rule<TightTolerances>();
}

TEST(TolerancesOfVertices, AreThePapersForItsR) {
  const Tolerances<double> papers = paper_tolerances(1.0);
  const Tolerances<double> own = PaperTolerances().of_edge(1.0, papers.R);
  EXPECT_EQ(own.S, papers.S);
  EXPECT_EQ(own.D2, papers.D2);
  EXPECT_EQ(own.lambda2, papers.lambda2);
  EXPECT_EQ(own.psi, papers.psi);
}

TEST(TolerancesOfVertices, TheTightOnesAreNearlyTheSmallest) {
  for (const double R : {0.0, 0x1p-40, 0x1p-20, 0x1p-13, 0x1p-5, 1.0}) {
    const Tolerances<double> own = TightTolerances().of_edge(1.0, R);
    const auto errors = full_errors(epsilon<double>(), own.S, epsilon<double>());
    const auto best = detail::edge_tolerances(errors, own.S, 1);
    EXPECT_LE(std::sqrt(own.D2), 1.1 * std::sqrt(best.D2)) << R;
  }
}

TEST(TolerancesOfVertices, EveryPairIsWithinALargeH) {
  for (const char* name : {"wang", "wang-plain", "wang-tight"})
    for (const double size : {1.0, 1e-310, 1e300})
      for (const double h : {2 * size, 1e9 * size, std::numeric_limits<double>::max()}) {
        Query query{.kind = Kind::vertex_edge, .separation = std::min(h, std::numeric_limits<double>::max())};
        query.x[3] = query.x[15] = size;
        query.x[7] = size / 2;
        repeat_vertices(query);
        EXPECT_TRUE(make_subject(name)->decide(query).hit) << name << ' ' << size << ' ' << h;
        EXPECT_GT(make_subject(name)->distance_bound(query), 0) << name << ' ' << size << ' ' << h;
      }
}

TEST(TolerancesOfVertices, AGivenBReplacesThePairs) {
  const Query query = make_query(testing::as_asked(find_family("v-uniform")), 1, 1);
  const double own = make_subject("wang")->distance_bound(query);
  EXPECT_GT(make_subject("wang@1e4")->distance_bound(query), 10 * own);
  EXPECT_TRUE(make_subject("wang-plain@1e9")->decide(query).hit);
  EXPECT_REFUSED(make_subject("wang-plain@1e-9")->decide(query), "is smaller than a pair's own");
}

TEST(TolerancesOfVertices, OnlySubjectsWithoutTimesAndTheOracleDecideThem) {
  for (const char* name : {"basic", "wang-time", "advance", "wang:dd", "defect:psi*0"}) {
    EXPECT_FALSE(make_any_subject(name)->decides(Kind::vertex_edge)) << name;
    EXPECT_FALSE(make_any_subject(name)->takes_separation(Kind::vertex_edge)) << name;
  }
  for (const char* name : {"wang", "wang-eps", "exact", "exact-decision"})
    EXPECT_TRUE(make_any_subject(name)->takes_separation(Kind::vertex_vertex)) << name;
}

TEST(TolerancesOfVertices, ABatchMayHaveEveryKind) {
  std::vector<Query> queries;
  for (std::uint64_t i = 0; i < 600; ++i) {
    const char* const family = i % 4 < 2 ? "uniform" : "v-uniform~drawn";
    queries.push_back(make_query(find_family(family), 1, i));
  }
  for (const char* name : {"wang", "wang-scalar", "wang-tight"}) {
    const auto subject = make_subject(name);
    std::vector<Verdict> verdicts(queries.size(), Verdict::accepted(Stage::exact, 2));  // left from before
    subject->decide(queries, verdicts);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const Verdict alone = subject->decide(queries[i]);
      EXPECT_EQ(verdicts[i].hit, alone.hit) << name << ' ' << i;
      EXPECT_EQ(verdicts[i].stage, alone.stage) << name << ' ' << i;
    }
  }
}

TEST(TolerancesOfVertices, APairWithoutSizeIsReported) {
  for (const Kind kind : {Kind::vertex_vertex, Kind::vertex_edge})
    for (const char* name : {"wang", "wang-tight"}) {
      EXPECT_TRUE(make_subject(name)->decide(Query{.kind = kind}).hit) << name;
      EXPECT_GE(make_subject(name)->distance_bound(Query{.kind = kind}), 0) << name;
    }
}

}  // namespace
}  // namespace nearmiss
