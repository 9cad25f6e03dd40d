// Every answer of the oracle has a certificate, which is accepted by a checker that shares no code with the
// oracle.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "fuzz/families/families.hpp"
#include "oracle/agreement/checked.hpp"
#include "oracle/certificates/certificate.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"
#include "tests/fuzz/family_queries.hpp"
#include "tests/queries.hpp"
#include "tools/certificates/check.hpp"

namespace nearmiss {
namespace {

using certificates::Statement;

void expect_apart(const Query& query, const Span& span, bool is_strict) {
  const auto text = certify_apart(query, span, is_strict);
  ASSERT_TRUE(text);
  EXPECT_EQ(certificates::check(*text), statement_about(query, "apart", span, is_strict));
}

void expect_meets(const Query& query, const Span& span, bool is_strict) {
  const auto text = certify_meets(query, span, is_strict);
  ASSERT_TRUE(text);
  EXPECT_EQ(certificates::check(*text), statement_about(query, "meets", span, is_strict));
}

template <class Function>
void for_queries(std::uint64_t count, const Function& f) {
  for (const Family& family : all_families())
    for (std::uint64_t i = 0; i < count; ++i) {
      SCOPED_TRACE(family.name + ":1:" + std::to_string(i));
      f(make_query(family, 1, i));
    }
}

TEST(CertificateOfEveryFamily, ProvesTheDecision) {
  for_queries(50, [](const Query& query) {
    const Decision decision = decide(query);
    if (decision.is_tie) return;
    const auto text = certify(query);
    ASSERT_TRUE(text);
    const char* const claim = decision.collision ? "meets" : "apart";
    EXPECT_EQ(certificates::check(*text),
              statement_about(query, claim, {}, query.separation > 0 || !decision.collision));
  });
}

/// Expects a proof that a time is late. For a query without a separation, the proof shows that the primitives
/// touch before this time. For a query with a separation, it shows that the primitives are closer than the
/// separation before this time.
void expect_late(const Query& query, double time) {
  const auto text = certify_meets(query, {0, time, true}, query.separation > 0);
  ASSERT_TRUE(text);
  Statement proven = certificates::check(*text);
  EXPECT_LT(proven.to, mpq_class(time));
  proven.to = 0;
  EXPECT_EQ(proven, statement_about(query, "meets", {0, 0}, query.separation > 0));
}

TEST(CertificateOfEveryFamily, ProvesTheTimeAndThatTheNextDoubleIsLate) {
  for_queries(20, [](const Query& query) {
    auto time = earliest_time(query);
    if (!time) return;
    const Enclosure t = time->enclosure();
    if (!decide(query).is_tie) {
      if (t.lo > 0) expect_apart(query, {0, t.lo, true}, true);
      expect_meets(query, {t.lo, t.hi}, false);
    }
    const double next = std::nextafter(t.lo, 2);
    if (next > 1) return;
    if (time->makes_late(next))
      expect_late(query, next);
    else
      EXPECT_FALSE(certify_meets(query, {0, next, true}, query.separation > 0));
  });
}

TEST(CertificateOfEveryFamily, ProvesTheDistance) {
  for_queries(10, [](const Query& query) {
    const auto [lo, hi] = minimum_distance(query);
    std::vector<Statement> expected;
    if (lo > 0) expected.push_back(statement_about(with_separation(query, lo), "apart", {}, false));
    if (std::isfinite(hi))
      expected.push_back(statement_about(with_separation(query, hi), "meets", {}, false));
    std::vector<Statement> proved;
    for (const auto& text : certify_distance(query)) proved.push_back(certificates::check(text.value()));
    EXPECT_EQ(proved, expected);
  });
}

TEST(Certificate, OfADistanceThatIsReachedAtAnIrrationalTimeIsThatOfTheNextDouble) {
  const Query query{.kind = Kind::vertex_triangle, .x = {0,  -.5, 5e-324, -1, 0,  0, 1, 0, 0, -1, 0,  0,  //
                                                         -1, -.5, 5e-324, -1, -1, 0, 1, 1, 0, -1, -1, 0}};
  ASSERT_EQ(minimum_distance(query).hi, 5e-324);
  const Certificates proofs = certify_distance(query);
  ASSERT_TRUE(proofs.back());
  EXPECT_EQ(certificates::check(*proofs.back()),
            statement_about(with_separation(query, 1e-323), "meets", {}, false));
}

// The smallest distance is at a rational time, at which the closest points have weights of 30,000 digits.
TEST(Certificate, HasNoLongerNumbersThanTheCheckersRead) {
  const Query query{.kind = Kind::edge_edge,
                    .x = {-0x1.d29303170fab2p+1018, -0x1.cd28dd6e89c6ap-1000, -0x1.8e4ed253d9e3p-500,
                          0x1.47aa2d9e2ec8dp+1018,  -0x1.54313be3e00fcp+1015, -0x1.ff6af81df6383p-500,
                          -0x1.c814deab7658cp+0,    -0x1.c75a28d0d866bp+1018, 0x1.783be88b224fp-500,
                          -0x1.71dba459ccb82p+1015, 0x1.93af0184cf29ap+1018,  0x1.b44a79866f058p-500,
                          -0x1.efd5959f63b7ep+1018, 0x1.d0b75ec7530d8p+0,     -0x1.929a1381ad12p-500,
                          0x1.bcf756713ac59p+1018,  -0x1.cb4b20fec3971p+0,    -0x1.7eed80d5f1c83p-500,
                          -0x1.169213d6a78d8p-1000, -0x1.fc520418bccadp+0,    0x1.a69110e532388p-500,
                          0x1.dd32c1d0b6d6dp+1015,  0x1.c2b88257cc465p+1018,  -0x1.d7eff04653cb9p-500}};
  for (const auto& text : certify_distance(query)) {
    ASSERT_TRUE(text);
    EXPECT_NO_THROW(certificates::check(*text));
  }
}

// The distance is below the separation for less than 2^-5000 of the step, at an irrational time.
TEST(Certificate, ProvesACollisionThatLastsNearlyNoTime) {
  constexpr double far = 0x1p1018;
  constexpr double tiny = 0x1p-1070;
  const Query contact = testing::make_query(Kind::vertex_triangle,
                                            {{-far, tiny, 3 * tiny},
                                             {0, 0, 0},
                                             {tiny, tiny, 2 * far},
                                             {0x1.d6b5b6f285be8p+1018, tiny, -0x1.12b0b56618ddep+990}},
                                            {{2 * far, tiny, 3 * tiny},
                                             {0, 0x1.2c60d9918a489p+1009, -0x1.1ff0a699ac81cp+1011},
                                             {tiny, tiny, -far},
                                             {-0x1.317e0acc9b252p+1013, -0x1.691773766ab19p+1013, 3 * tiny}});
  const Query query = with_separation(contact, 2 * tiny);
  ASSERT_TRUE(decide(query).collision);
  expect_meets(query, {}, true);
}

TEST(Certificate, ATieIsProvedIfItsTimeIsRational) {
  // The vertex passes the triangle's corner at a distance of exactly 1, at t = 1/2.
  const Query query{.kind = Kind::vertex_triangle,
                    .x = {-1, 0, 1, 0, 0, 0, 0, 2, 0, 0, 0, -1, 1, 0, 1, 0, 0, 0, 0, 2, 0, 0, 0, -1},
                    .separation = 1};
  ASSERT_TRUE(decide(query).is_tie);
  expect_meets(query, {}, false);
  EXPECT_FALSE(certify_meets(query, {}, true));
  EXPECT_FALSE(certify_apart(query, {}, true));
  expect_apart(query, {}, false);
}

TEST(Certificate, ProvesATimeFarBelowOneThatIsIrrational) {
  const Query query{.kind = Kind::edge_edge, .x = {-0x1p1010, 0,        0, 0,        0, 1, 0, 0, 0, 0, 1, 1,
                                                   0,         0x1p1010, 0, 0x1p1010, 0, 0, 0, 0, 0, 0, 0, 1}};
  const Enclosure t = earliest_time(query)->enclosure();  // about 2^-505
  ASSERT_LT(t.lo, t.hi);
  expect_apart(query, {0, t.lo, true}, true);
  expect_meets(query, {t.lo, t.hi}, false);
}

TEST(Certificate, ProvesATimeThatIsLateByLessThanTheStepBetweenDoubles) {
  // The vertex meets the triangle at t = 1/5, which is less than the double 0.2.
  const Query rational{.kind = Kind::vertex_triangle, .x = {0.25, 0.25, 1,  0, 0, 0, 1, 0, 0, 0, 1, 0,  //
                                                            0.25, 0.25, -4, 0, 0, 0, 1, 0, 0, 0, 1, 0}};
  expect_late(rational, 0.2);
  EXPECT_FALSE(certify_meets(rational, {0, std::nextafter(0.2, 0), true}));
  // At the time t with 2 t² = 1, the vertex meets the inside of the triangle (`inside`), or the triangle's
  // edge x1x2 in a plane in which all vertices move (`border`).
  const Query inside{.kind = Kind::vertex_triangle, .x = {0, 0, 1, -8, -8, 0,  8, -8, 0, 0, 8, 0,  //
                                                          2, 0, 1, -8, -8, -8, 8, -8, 8, 0, 8, 0}};
  const Query border{.kind = Kind::vertex_triangle, .x = {0, 1, 0, -8, 0,  0, 8, 0, 0, 0, -20, 0,  //
                                                          2, 1, 0, -8, -8, 0, 8, 8, 0, 0, -20, 0}};
  for (const Query& query : {inside, border}) {
    const Enclosure time = earliest_time(query)->enclosure();
    ASSERT_LT(time.lo, time.hi);
    expect_late(query, time.hi);
    EXPECT_FALSE(certify_meets(query, {0, time.lo, true}));
  }
}

// The edge passes below the vertex. The distance between the two is exactly 1 at t, and larger at all other
// times.
TEST(Certificate, ProvesThatADistanceIsNeverBelowOneThatIsReachedAtATimeOfFewBits) {
  for (int k = 1; k <= 15; ++k) {
    SCOPED_TRACE(k);
    const double t = std::ldexp(1.0, -k);
    const Query query{.kind = Kind::vertex_triangle,
                      .x = {0, -2 * t,      1, -1, 0, t,     1, 0, -t,    -1, 0, t,  //
                            0, 2 * (1 - t), 1, -1, 0, t - 1, 1, 0, 1 - t, -1, 0, t - 1},
                      .separation = 1};
    ASSERT_TRUE(decide(query).is_tie);
    expect_apart(query, {}, false);
  }
}

// The primitives meet at the end of the span, so the statement that they are apart is false. The search for a
// proof of this statement must end.
TEST(Certificate, TheSearchEndsForContactAtTheEndOfASpan) {
  const Query query{.kind = Kind::vertex_triangle, .x = {0.25, 0.25, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0,  //
                                                         0.25, 0.25, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0}};
  EXPECT_FALSE(certify_apart(query, {0.5, 1}));
}

TEST(Certificate, AWrongDecisionHasNone) {
  for (const char* family : {"uniform", "planted", "near-separation"}) {
    const Query query = make_query(find_family(family), 1, 0);
    Decision decision = decide(query);
    EXPECT_TRUE(is_proved(query, decision));
    decision.collision = !decision.collision;
    EXPECT_FALSE(is_proved(query, decision));
  }
}

TEST(Certificate, NothingFalseIsProved) {
  const Query query = make_query(find_family("planted"), 1, 0);
  EXPECT_FALSE(certify_apart(query, {}));
  EXPECT_FALSE(certify_meets(make_query(find_family("uniform-slow"), 1, 0), {}));
}

}  // namespace
}  // namespace nearmiss
