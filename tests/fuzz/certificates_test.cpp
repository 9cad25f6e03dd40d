// Every answer of the oracle has a certificate, which a checker that shares no code with the oracle accepts.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "fuzz/families/families.hpp"
#include "fuzz/random.hpp"
#include "fuzz/trial/certified.hpp"
#include "oracle/certificates/certificate.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"
#include "tests/fuzz/family_queries.hpp"
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

class OfFamily : public ::testing::TestWithParam<Family> {
 protected:
  /// Calls a function with queries of the family.
  template <class Function>
  static void for_queries(std::uint64_t count, const Function& f) {
    for (std::uint64_t i = 0; i < count; ++i) {
      SCOPED_TRACE(i);
      f(make_query(GetParam(), 1, i));
    }
  }
};
INSTANTIATE_TEST_SUITE_P(Certificate, OfFamily,
                         ::testing::ValuesIn(all_families().begin(), all_families().end()),
                         testing::name_of_test);

TEST_P(OfFamily, ProvesTheDecision) {
  for_queries(100, [](const Query& query) {
    const Decision decision = decide(query);
    if (decision.is_tie) return;
    const auto text = certify(query);
    ASSERT_TRUE(text);
    const char* const claim = decision.collision ? "meets" : "apart";
    EXPECT_EQ(certificates::check(*text),
              statement_about(query, claim, {}, query.separation > 0 || !decision.collision));
  });
}

TEST_P(OfFamily, ProvesTheTime) {
  for_queries(20, [](const Query& query) {
    if (decide(query).is_tie) return;
    auto time = earliest_time(query);
    if (!time) return;
    const Enclosure t = time->enclosure();
    if (t.lo > 0) expect_apart(query, {0, t.lo, true}, true);
    expect_meets(query, {t.lo, t.hi}, false);
  });
}

/// Expects a proof that something happens before a time, for h > 0 a distance below h.
void expect_late(const Query& query, double time) {
  const auto text = certify_meets(query, {0, time, true}, query.separation > 0);
  ASSERT_TRUE(text);
  Statement proven = certificates::check(*text);
  EXPECT_LT(proven.to, mpq_class(time));
  proven.to = 0;
  EXPECT_EQ(proven, statement_about(query, "meets", {0, 0}, query.separation > 0));
}

TEST_P(OfFamily, ProvesThatTheNextDoubleIsLate) {
  for_queries(20, [](const Query& query) {
    auto time = earliest_time(query);
    if (!time) return;
    const double next = std::nextafter(time->enclosure().lo, 2);
    if (next > 1) return;
    if (time->makes_late(next))
      expect_late(query, next);
    else
      EXPECT_FALSE(certify_meets(query, {0, next, true}, query.separation > 0));
  });
}

TEST_P(OfFamily, ProvesTheDistance) {
  for_queries(20, [](const Query& query) {
    const Enclosure distance = minimum_distance(query);
    if (distance.lo > 0) expect_apart(with_separation(query, distance.lo), {}, false);
    if (std::isfinite(distance.hi)) expect_meets(with_separation(query, distance.hi), {}, false);
  });
}

/// Whether the oracle agrees with a statement about the beginning of the step; nothing for any other statement.
std::optional<bool> is_true(const Statement& statement) {
  if (statement.from != 0 || statement.to != mpq_class(statement.to.get_d())) return std::nullopt;
  Query query{.kind = statement.kind == "vt" ? Kind::vertex_triangle : Kind::edge_edge,
              .separation = statement.h};
  std::copy(statement.x.begin(), statement.x.end(), query.x.begin());
  const bool is_apart = statement.claim == "apart";
  auto time = earliest_time(query);
  if (!time) return is_apart;
  const double end = statement.to.get_d();
  // For h > 0, t* is the first time with a distance of h, and "late" means a distance below h.
  const bool within = time->is_before(statement.open ? end : std::nextafter(end, 2.0));
  const bool below =
      query.separation > 0 && time->makes_late(statement.open ? end : std::nextafter(end, 2.0));
  if (is_apart) return statement.strict ? !within : !below;
  return statement.strict ? below : within;
}

/// Changes one character of a text at random: a digit, a sign, or a letter.
std::string mutated(std::string text, Random& random) {
  const auto at = static_cast<std::size_t>(random.integer(0, static_cast<int>(text.size()) - 1));
  constexpr std::string_view alphabet = "0123456789abcdefp-/x";
  text[at] = alphabet[static_cast<std::size_t>(random.integer(0, static_cast<int>(alphabet.size()) - 1))];
  return text;
}

TEST(Certificate, NoChangedOneProvesAFalsehood) {
  Random random(1, 2, 3);
  int accepted = 0;
  int judged = 0;
  for (const Family& family : all_families())
    for (std::uint64_t i = 0; i < 6; ++i) {
      const auto text = certify(make_query(family, 1, i));
      if (!text) continue;
      for (int change = 0; change < 40; ++change) {
        const std::string changed = mutated(*text, random);
        try {
          const Statement claimed = certificates::check(changed);
          ++accepted;
          const auto truth = is_true(claimed);
          EXPECT_TRUE(truth.value_or(true)) << changed;
          judged += truth ? 1 : 0;
        } catch (const certificates::Refused&) {
        }
      }
    }
  EXPECT_GT(accepted, 1000);
  EXPECT_GT(judged, 900);
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
  // The vertex meets the triangle at t = 1/5, which is less than 0.2.
  const Query rational{.kind = Kind::vertex_triangle, .x = {0.25, 0.25, 1,  0, 0, 0, 1, 0, 0, 0, 1, 0,  //
                                                            0.25, 0.25, -4, 0, 0, 0, 1, 0, 0, 0, 1, 0}};
  expect_late(rational, 0.2);
  EXPECT_FALSE(certify_meets(rational, {0, std::nextafter(0.2, 0), true}));
  // The vertex meets the inside of the triangle, or its edge x1x2 in a plane, when 2 t^2 = 1.
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

TEST(Certificate, AWrongDecisionHasNone) {
  for (const char* family : {"uniform", "planted", "near-separation"}) {
    const Query query = make_query(find_family(family), 1, 0);
    Decision decision = decide(query);
    EXPECT_EQ(certificate_disagreement(query, decision), "");
    decision.collision = !decision.collision;
    EXPECT_EQ(certificate_disagreement(query, decision), "certificate (refused)");
  }
}

TEST(Certificate, NothingFalseIsProved) {
  const Query query = make_query(find_family("planted"), 1, 0);
  EXPECT_FALSE(certify_apart(query, {}));
  EXPECT_FALSE(certify_meets(make_query(find_family("uniform-slow"), 1, 0), {}));
}

}  // namespace
}  // namespace nearmiss
