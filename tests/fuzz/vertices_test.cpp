// For vv and ve, wang reports every pair that comes within the separation h, and no pair that stays farther
// apart than h plus wang's bound.
#include <CGAL/Interval_nt.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "ccd/wang/bounds/tight_tolerances.hpp"
#include "ccd/wang/within.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/subjects/defects.hpp"
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
  const Family family = as_asked(GetParam());
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

/// Encloses the number that was rounded to x.
Interval enclosure(double x) { return {std::nextafter(x, -HUGE_VAL), std::nextafter(x, HUGE_VAL)}; }

/// Expects that the tolerances `computed`, for the bound B, satisfy the constraints for ve if `of_edge` is
/// true, and the constraints for vv otherwise.
void expect_constraints(const Tolerances<double>& computed, double B, bool of_edge) {
  const Interval b(B);
  Tolerances<Interval> tol;
  tol.delta = enclosure(computed.delta) / b / b;
  tol.D2 = enclosure(computed.D2) / b / b;
  tol.rho = enclosure(computed.rho) / b / b;
  tol.psi = enclosure(computed.psi) / b / b;
  tol.lambda2 = enclosure(computed.lambda2) / b / b;
  tol.S = enclosure(computed.S) / b;
  tol.mu = tol.tau = tol.eta = 1;  // the tested constraints do not depend on these three tolerances
  const auto errors = full_errors(Interval(epsilon<double>()), tol.S, tol.rho);
  for (const auto& each : constraints(tol, Interval(1), Interval(1), errors))
    if (each.about == "VV" || (of_edge && each.about.starts_with("VE"))) {
      EXPECT_GE(each.more.inf(), each.less.sup()) << each.about << ", R = " << computed.R << ", B = " << B;
    }
}

/// Calls check(R) for many thresholds R of the distance, from 0 to 4 B, where B is the pair's bound. With a
/// larger R, primitives are always within R of each other.
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
  const Query query = make_query(as_asked(find_family("v-uniform")), 1, 1);
  const double own = make_subject("wang")->distance_bound(query);
  EXPECT_GT(make_subject("wang@1e4")->distance_bound(query), 10 * own);
  EXPECT_TRUE(make_subject("wang-plain@1e9")->decide(query).hit);
  EXPECT_REFUSED(make_subject("wang-plain@1e-9")->decide(query), "is smaller than a pair's own");
}

// Tests the bounds that wang claims in narrow scalars: for primitives with the smallest coordinates, and for
// a given B that the scalar cannot represent.
TEST(TolerancesOfVertices, BoundsOfNarrowScalarsHoldAtTheEndsOfTheRange) {
  for (const char* name : {"wang:float", "wang-tight:float", "wang:p16", "wang-tight:dd"}) {
    const auto subject = make_any_subject(name);
    const auto beyond = make_any_subject(std::string(name) + "@1e100");
    for (std::uint64_t i = 0; i < 400; ++i) {
      Query tiny = make_query(find_family("v-small-integer"), 1, i);
      for (double& c : tiny.x) c *= 0x1p-1074;
      tiny.separation = static_cast<double>(1 + i % 3) * 0x1p-1074;
      EXPECT_GT(subject->distance_bound(tiny), 0) << name << ' ' << i;
      for (const Query& query : {tiny, make_query(find_family("v-uniform~drawn"), 1, i)}) {
        const Subject& of = query.separation < 1e-300 ? *subject : *beyond;
        const Query rounded = of.rounded(query);
        const bool hit = of.decide(query).hit;
        EXPECT_TRUE(hit || !collides(rounded)) << name << ' ' << i;
        EXPECT_FALSE(hit && distance_exceeds_separation_by(rounded, of.distance_bound(query)))
            << name << ' ' << i;
      }
    }
  }
}

TEST(TolerancesOfVertices, AreThoseOfSomeSubjects) {
  for (const char* name : {"basic:float", "adaptive"}) {
    EXPECT_FALSE(make_any_subject(name)->decides(Kind::vertex_edge)) << name;
    EXPECT_FALSE(make_any_subject(name)->takes_separation(Kind::vertex_edge)) << name;
  }
  for (const char* name : {"wang", "wang-eps", "wang-time", "advance", "exact", "exact-decision"})
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
    std::vector<Verdict> verdicts(queries.size(), Verdict::accepted(Stage::exact, 2));  // must be overwritten
    subject->decide(queries, verdicts);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const Verdict alone = subject->decide(queries[i]);
      EXPECT_EQ(verdicts[i].hit, alone.hit) << name << ' ' << i;
      EXPECT_EQ(verdicts[i].stage, alone.stage) << name << ' ' << i;
    }
  }
}

/// For each of the five cases of the paper's Algorithm 2, whether this case accepts the vertex. Cases 1 to 4
/// accept the vertex if it is near the edge at a candidate time of the case. Case 5 accepts the vertex if it
/// is near an end of the edge.
std::array<bool, 5> cases_that_accept(const Query& query) {
  const WithinQuery<double> pair(query);
  const Tolerances<double> tol = pair.tolerances(query.kind, PaperTolerances());
  const auto any_near = [&](const auto& times) {
    return std::any_of(times.begin(), times.end(),
                       [&](double t) { return detail::near_edge(pair.ve, t, tol); });
  };
  const detail::CrossProduct<double> g(pair.ve.x0i, pair.ve.xji, tol.rho);
  return {any_near(std::array{0.0, 1.0}), any_near(detail::piece_minima(g, pair.ve.xji, tol.S)),
          any_near(detail::equal_components(pair.ve.xji)), any_near(detail::zero_components(g)),
          vertex_vertex(pair.ve.x0i, tol) || vertex_vertex(pair.ve.x0j, tol)};
}

// As the proof in vertex_edge.hpp says, no query is reported by case 3 only.
TEST(TheCasesOfAlgorithm2, FindSomeCollisionsAloneExceptTheThird) {
  std::array<int, 5> alone{};
  for (const Family& each : vertex_families()) {
    const Family family = as_asked(each);
    for (std::uint64_t i = 0; i < 100; ++i) {
      const Query query = make_query(family, 1, 2 * i + 1);
      if (WithinQuery<double>(query).is_always_within() || !collides(query)) continue;
      const std::array<bool, 5> accepts = cases_that_accept(query);
      ASSERT_TRUE(std::ranges::count(accepts, true) > 0) << family.name << ' ' << i;
      if (std::ranges::count(accepts, true) == 1)
        ++alone[static_cast<std::size_t>(std::ranges::find(accepts, true) - accepts.begin())];
    }
  }
  EXPECT_GT(alone[0], 20);
  EXPECT_GT(alone[1], 20);
  EXPECT_EQ(alone[2], 0);
  EXPECT_GT(alone[3], 20);
  EXPECT_GT(alone[4], 20);
}

TEST(ClosestApproach, MissesHardlyAnythingAwayFromH) {
  const auto basic = make_subject("basic");
  const Family family = as_asked(find_family("v-uniform"));
  for (const Kind kind : kinds_of_vertices) {
    int collisions = 0;
    int wrong = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const Query query = make_query(family, 1, i);
      if (query.kind != kind) continue;
      const Verdict verdict = basic->decide(query);
      const bool collides = nearmiss::collides(query);
      collisions += collides ? 1 : 0;
      wrong += verdict.hit != collides ? 1 : 0;
      if (verdict.hit && collides) {
        EXPECT_NEAR(verdict.time, earliest_time(query)->enclosure().lo, 1e-6) << i;
      }
    }
    EXPECT_GT(collisions, 50);
    EXPECT_EQ(wrong, 0);
  }
}

TEST(ClosestApproach, MissesWhatComesToWithinHExactly) {
  const auto basic = make_subject("basic");
  const Family family = find_family("v-near-separation@-54");
  int missed = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const Query query = make_query(family, 1, i);
    missed += collides(query) && !basic->decide(query).hit ? 1 : 0;
  }
  EXPECT_GT(missed, 15);
}

TEST(DefectsOfVerticesAndEdges, AreFoundByFamiliesOfTheirOwn) {
  const auto misses = [](const char* defect, const char* name, std::uint64_t queries) {
    const auto subject = try_make_defect(defect);
    const Family family = as_asked(find_family(name));
    int count = 0;
    for (std::uint64_t i = 0; i < queries; ++i) {
      const Query query = make_query(family, 1, 2 * i + 1);
      count += !subject->decide(query).hit && collides(query) ? 1 : 0;
    }
    return count;
  };
  EXPECT_GT(misses("defect:ve-minimum", "v-minimum", 200), 10);
  EXPECT_GT(misses("defect:ve-zero", "v-near-separation", 500), 5);
  EXPECT_GT(misses("defect:S*0.5", "v-near-separation", 500), 0);
  EXPECT_GT(misses("defect:rho*100", "v-drifting@-17", 5000), 0);
  EXPECT_EQ(misses("defect:S*1", "v-minimum", 200), 0);
}

}  // namespace
}  // namespace nearmiss
