// The audit of rounding constants.
#include "fuzz/studies/audit/audit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>

#include "ccd/constraints.hpp"
#include "ccd/cubic.hpp"
#include "ccd/proximity.hpp"
#include "ccd/vertex_edge.hpp"
#include "fuzz/studies/audit/samples.hpp"
#include "oracle/oracle.hpp"
#include "tests/bit_hash.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using audit_parts::AuditedRational;
using audit_parts::exact_time;

const std::vector<AuditRow>& rows() {
  static const auto all = audit({.seed = 1, .queries = 50, .steps = 400});
  return all;
}

TEST(Audited, FollowsTheRulesOfTheTheorem) {
  const AuditedRational x(0.1, 0.1, {1, 1, 0});
  EXPECT_EQ((x + x).bound(), (ErrorBound{2, 1, 1}));
  EXPECT_EQ((x * x - x * x).bound(), (ErrorBound{2, 2, 2}));
  EXPECT_EQ(((x * x) * (x + x)).bound(), (ErrorBound{2, 3, 3}));
  EXPECT_EQ((3 * x).bound(), (ErrorBound{3, 1, 1}));
  EXPECT_EQ((2 * x).bound(), (ErrorBound{2, 1, 0}));
  EXPECT_EQ((x / 4).bound(), (ErrorBound{0.25, 1, 1}));
  EXPECT_EQ((x * x / 4).bound(), (ErrorBound{0.25, 2, 2}));
  EXPECT_EQ((exact_time(1) * x).bound(), (ErrorBound{1, 1, 1}));
  EXPECT_TRUE(std::isinf((x / x).bound().error()));
}

TEST(Audited, KnowsTheExactValue) {
  const AuditedRational x(0.1, 0.1, {1, 1, 0});
  const AuditedRational square = x * x;
  EXPECT_EQ(square.value(), 0.1 * 0.1);
  EXPECT_EQ(static_cast<double>(square.error()), -std::fma(0.1, 0.1, -(0.1 * 0.1)));
}

TEST(Audited, KeepsAPositionWithinTheBoundOfItsEnds) {
  Moving<double> unit;
  unit.xv << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6;
  const auto at = audit_parts::exactly(unit).at(exact_time(0.7));
  EXPECT_EQ(at[0].bound(), (ErrorBound{1, 1, 2}));
  EXPECT_EQ(at[0].value(), unit.at(0.7)[0]);
}

/// A hash of the first samples and of their changes.
std::uint64_t fingerprint_of_samples(double reach) {
  testing::BitHash hash;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    Random random(1, 0, i);
    const auto drawn = audit_parts::draw_sample(random, reach);
    for (const auto& sample : {drawn, audit_parts::changed(random, drawn)}) {
      for (const Moving<double>* vector : {&sample.p, &sample.q, &sample.r}) hash.add_all(vector->xv);
      hash.add_all(std::array{sample.t, sample.eta, sample.S});
    }
  }
  return hash.value();
}

// A seed of `nearmiss audit` keeps its meaning.
TEST(Audit, DrawsTheSamplesThatItAlwaysDrew) {
  EXPECT_EQ(fingerprint_of_samples(1), 0x84e8ad84fd597905) << std::hex << fingerprint_of_samples(1);
  EXPECT_EQ(fingerprint_of_samples(2), 0xbc58b38180eaa708) << std::hex << fingerprint_of_samples(2);
}

TEST(Audit, SeesNoMoreThanTheRulesAllow) {
  for (const AuditRow& row : rows()) {
    EXPECT_EQ(row.violations, 0) << row.name;
    EXPECT_FALSE(row.seen > row.derived) << row.name;
  }
}

TEST(Audit, SeesSomething) {
  for (const AuditRow& row : rows()) EXPECT_NE(row.seen, 0) << row.name;
}

TEST(Audit, GivesTheSameForTheSamePlan) {
  const AuditPlan plan{.seed = 3, .queries = 4, .steps = 20};
  const auto one = audit(plan);
  const auto two = audit(plan);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].derived, two[i].derived);
    EXPECT_TRUE(one[i].seen == two[i].seen || std::isnan(one[i].seen));
  }
}

// ccd/ has the operations that the paper counts, with the paper's B_f and k_f.
TEST(Audit, FindsThePapersBoundsInOurOperations) {
  std::map<std::string_view, ErrorBound> bounds;
  for (const AuditRow& row : rows())
    bounds.emplace(row.name, row.bound);  // the first row with a name is the paper's
  EXPECT_EQ(bounds["VV: m = x.v"], (ErrorBound{3, 2, 3}));
  EXPECT_EQ(bounds["VE: squared length"], (ErrorBound{3, 2, 7}));
  EXPECT_EQ(bounds["VE: weight"], (ErrorBound{3, 2, 7}));
  EXPECT_EQ(bounds["F: a, d"], (ErrorBound{6, 3, 5}));
  EXPECT_EQ(bounds["F: b, c"], (ErrorBound{18, 3, 7}));
  EXPECT_EQ(bounds["F(t)"], (ErrorBound{48, 3, 12}));
  EXPECT_EQ(bounds["VT: N"], (ErrorBound{2, 2, 6}));
  EXPECT_EQ(bounds["VT: height test"], (ErrorBound{4, 2, 6}));
  EXPECT_EQ(bounds["VT: weight"], (ErrorBound{12, 4, 15}));
  EXPECT_EQ(bounds["VT: barycentric test"], (ErrorBound{36, 4, 16}));
  EXPECT_EQ(bounds["EE: height test"], (ErrorBound{3, 2, 6}));
  EXPECT_EQ(bounds["EE: barycentric test"], (ErrorBound{24, 4, 15}));
  EXPECT_EQ(bounds["EE: barycentric test, far p"], (ErrorBound{36, 4, 15}));
}

/// The derived error of each row by its name. Rows with the rounding of relative vectors have their own
/// names.
const std::map<std::string, double>& derived_errors() {
  static const auto derived = [] {
    std::map<std::string, double> by_name;
    for (const AuditRow& row : rows())
      by_name.emplace(std::string(row.name) + (row.note.starts_with("with the rounding") ? ", rounded" : ""),
                      row.derived);
    return by_name;
  }();
  return derived;
}

void expect_derived(const std::map<std::string, double>& expected, double tolerance) {
  for (const auto& [name, value] : expected) EXPECT_NEAR(derived_errors().at(name), value, tolerance) << name;
}

TEST(Audit, DerivesTheErrorsOfTheVertexAndEdgeTests) {
  expect_derived({{"VV: m = x.v", 9},
                  {"VV: n = v.v", 9},
                  {"VV: time", 9.5},
                  {"VV: squared distance moved", 114},
                  {"VV: delta", 135},
                  {"VV of EE: delta", 420},
                  {"VE: squared length", 21},
                  {"VE: weight", 21},
                  {"VE: barycentric test", 42},
                  {"VE: F_0ij", 63},
                  {"VE of EE: squared length", 21},
                  {"VE of EE: weight", 42},
                  {"VE of EE: barycentric test", 63},
                  {"VE of EE: F_0ij", 117},
                  {"VE: residual of case 4", 40},
                  {"VE of EE: residual of case 4", 62}},
                 1e-9);
}

TEST(Audit, DerivesTheErrorsOfTheCubicAndTheProximityTests) {
  expect_derived({{"F: a, d", 30},
                  {"F: b, c", 126},
                  {"F(t)", 576},
                  {"cubic solver", 552},
                  {"VT: N", 12},
                  {"VT: height test", 20},
                  {"VT: weight", 180},
                  {"VT: barycentric test", 564},
                  {"EE: N", 12},
                  {"EE: height test", 15},
                  {"EE: weight", 180},
                  {"EE: barycentric test", 360},
                  {"EE: weight, far p", 360},
                  {"EE: barycentric test, far p", 540},
                  {"VE culling: spread of a weight", 9}},
                 1e-9);
}

TEST(Audit, DerivesTheErrorsWithTheRoundingOfRelativeVectors) {
  expect_derived({{"VT: N, rounded", 14},
                  {"VT: height test, rounded", 22},
                  {"VT: weight, rounded", 186},
                  {"VT: barycentric test, rounded", 570},
                  {"weight_error, rounded", 570},
                  {"EE: N, rounded", 14},
                  {"EE: height test, rounded", 17.5},
                  {"EE: weight, rounded", 186},
                  {"EE: barycentric test, rounded", 372},
                  {"F(t), rounded", 480},
                  {"clearance, rounded", 72},
                  {"B, rounded", 14},
                  {"critical points", 54}},
                 1e-9);
}

// The bound is 12ρ plus terms of the order of ε: three components twice, the slope of a piece, and the times
// of roots. For ψ, the error of F_0ij is added.
TEST(Audit, DerivesPsiFromRho) {
  const double S = 18 * 0x1p-13;
  const double near = 6 * (4 + 12 + 4 + 4) + (26 + S) + 6 * (24 + S);
  const double far = 6 * (4 + 18 + 8 + 8) + (34 + S) + 6 * (30 + S);
  expect_derived({{"VE: G of case 4", 36 + near * 0x1p-26},
                  {"VE of EE: G of case 4", 36 + far * 0x1p-26},
                  {"VE: psi", 36 + (near + 63) * 0x1p-26},
                  {"VE of EE: psi", 36 + (far + 117) * 0x1p-26}},
                 1e-12);
}

// The paper assumes that relative positions of edges are bounded by B. Constants that depend on this
// assumption are too small, except δ.
TEST(Audit, FindsWhatThePaperHasTooSmall) {
  std::vector<std::string> findings;
  for (const AuditRow& row : rows())
    if (row.is_finding()) findings.emplace_back(row.name);
  EXPECT_THAT(findings,
              ::testing::ElementsAre("VE of EE: weight", "VE of EE: barycentric test", "EE: weight, far p",
                                     "EE: barycentric test, far p", "EE: distance from an edge line, far p",
                                     "EE: distance of a false positive, far p"));
}

// With the rounding of relative vectors, the theorem's bound is less than 10 % above the paper's constants.
// The bound that Gappa proves is below them.
TEST(Audit, KnowsWhatHoldsThoughTheTheoremDoesNotShowIt) {
  std::vector<std::string> names;
  for (const AuditRow& row : rows())
    if (row.needs_proof()) names.emplace_back(row.name);
  EXPECT_THAT(names, ::testing::ElementsAre("VV of EE: delta", "VT: N", "VT: height test", "VT: weight",
                                            "VT: barycentric test", "EE: N", "EE: height test", "EE: weight",
                                            "EE: barycentric test"));
  for (const AuditRow& row : rows()) {
    if (row.note.starts_with("with the rounding")) {
      EXPECT_LT(row.derived, 1.1 * row.quoted) << row.name;
      EXPECT_LT(row.proven, row.quoted) << row.name;
    }
  }
}

TEST(Audit, QuotesThePaper) {
  const std::map<std::string_view, double> printed{
      {"F: a, d", 30}, {"F: b, c", 126}, {"cubic solver", 33492}};
  std::map<std::string_view, double> quoted;
  for (const AuditRow& row : rows())
    if (printed.contains(row.name)) quoted[row.name] = row.quoted;
  EXPECT_EQ(quoted, printed);
}

TEST(Audit, SeesNoMoreThanIsProven) {
  for (const AuditRow& row : rows()) EXPECT_FALSE(row.seen > row.proven) << row.name;
}

/// A moving vector with a bound of its ends, and with the numbers of roundings in its position and its
/// velocity.
Moving<AuditedRational> leaves(double reach, int position, int velocity) {
  Moving<AuditedRational> vector;
  for (int i = 0; i < 6; ++i)
    vector.xv[i] = {0.1 * i, 0.1 * i, {i < 3 ? reach : 1, 1, i < 3 ? position : velocity}};
  return vector;
}

// Constants of constraints.hpp in units of u, for B = 1. The bound of the residual follows the paper's rules.
// For the others, Gappa proves smaller bounds than the rules give.
TEST(FullErrors, AreNotAboveThoseOfTheRules) {
  const double eps = 0x1p-60;
  const auto errors = full_errors(eps, 1.0, 0.0);
  const auto roundings = [&](double error) { return error / (eps / 2); };
  std::vector<std::pair<AuditedRational, AuditedRational>> kept;
  const ComparisonLog<audit_parts::Rational> log(kept);
  const auto taken = [&](std::size_t i) {
    return kept.at(i).first.bound().error() + kept.at(i).second.bound().error();
  };
  Tolerances<AuditedRational> tol{};
  tol.eta = tol.S = audit_parts::threshold(1, 1);

  Pair<Kind::vertex_triangle, AuditedRational> vt;
  vt.p = vt.q = vt.r = leaves(1, 1, 3);
  const Configuration triangle(vt, exact_time(0.5));
  std::ignore = triangle.well_shaped(tol, log);
  EXPECT_LT(roundings(errors.area), taken(0));
  std::ignore = triangle.inside(log);
  EXPECT_LT(roundings(errors.weight_vt), taken(7));

  kept.clear();
  Pair<Kind::edge_edge, AuditedRational> ee;
  ee.p = leaves(2, 1, 4);
  ee.q = ee.r = leaves(1, 1, 3);
  const Configuration quadrilateral(ee, exact_time(0.5));
  std::ignore = quadrilateral.well_shaped(tol, log);
  EXPECT_LT(roundings(errors.height_ee), taken(1));
  std::ignore = quadrilateral.inside(log);
  EXPECT_LT(roundings(errors.weight_ee), std::max(taken(3), taken(5)));

  kept.clear();
  const VertexEdge<AuditedRational> ve{leaves(2, 1, 5), leaves(1, 1, 3), leaves(2, 1, 5)};
  detail::near_edge(ve, exact_time(0.5), tol, log);
  EXPECT_LT(roundings(errors.length2), taken(0));
  EXPECT_LT(roundings(errors.weight_ve), taken(2));
  EXPECT_LT(roundings(errors.F), taken(3));
}

// Constants of solver_errors.hpp in units of u, for B = S = 1. Underflow counts as 1 u.
TEST(FullErrors, OfTheSolversAreThoseOfTheRules) {
  const double eps = 0x1p-60;
  const auto errors = full_errors(eps, 1.0, 0.0);
  const auto roundings = [&](double error) { return error / (eps / 2); };
  const double underflow = 1;
  Pair<Kind::edge_edge, AuditedRational> ee;
  ee.q = ee.r = leaves(1, 1, 3);
  ee.p = leaves(1, 1, 4);
  const auto F = coplanarity(ee);
  double coefficients = 0;
  for (const AuditedRational* c : {&F.a, &F.b, &F.c, &F.d}) coefficients += c->bound().error();
  EXPECT_NEAR(roundings(errors.residual),
              cubic_error(coefficients, horner_error(6, 18, 18, 6), 18) + underflow, 1e-9);

  const detail::CrossProduct<AuditedRational> g(leaves(2, 1, 5), leaves(1, 1, 3),
                                                audit_parts::threshold(-1, 2));
  const auto bound = [](const AuditedRational& x) { return x.bound(); };
  const double kappa = bound(g.a[0]).error() + bound(g.b[0]).error() + bound(g.c[0]).error();
  const double vectors = 2 * (1 + 3);  // errors of x_ji, times S
  std::vector<std::pair<AuditedRational, AuditedRational>> kept;
  Tolerances<AuditedRational> tol{};
  tol.S = audit_parts::threshold(1, 1);
  detail::near_edge(VertexEdge<AuditedRational>{leaves(2, 1, 5), leaves(1, 1, 3), leaves(2, 1, 5)},
                    exact_time(0.5), tol, ComparisonLog<audit_parts::Rational>(kept));
  const double F_0ij = kept.at(3).first.bound().error() + kept.at(3).second.bound().error();
  EXPECT_NEAR(roundings(errors.least_psi),
              candidate_error(kappa + 2 * bound(g.c[0]).coefficient, bound(g.a[0]).coefficient,
                              bound(g.b[0]).coefficient, 1) +
                  vectors + F_0ij + underflow,
              1e-9);
}

// §4.1: "B is also an upper bound on the relative positions at any time", and x20 is the closest pair. Here
// x1 and x2 are the closest end points at t = 0, at distance 1.5. At t = 1 their distance is 5. B is 1 + 3.5.
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
