// The checker accepts the certificates that nearmiss_certificate() writes, and each certificate states
// exactly what was asked.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cfenv>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "ccd/query/arithmetic.hpp"
#include "oracle/interface/nearmiss.hpp"
#include "tests/arithmetic_modes.hpp"
#include "tools/certificates/check.hpp"

namespace nearmiss {
namespace {

using ::certificates::Statement;
using ::testing::ElementsAre;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::array all_proofs{Prove::decision, Prove::time, Prove::distance};

/// A triangle at height 0, and a vertex that falls from height 1 to height `to`.
constexpr std::array<double, 24> falling(double to) {
  return {0.25, 0.25, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.25, 0.25, to, 0, 0, 0, 1, 0, 0, 0, 1, 0};
}

/// The distance between x0 and the inside of the edge x1x2 is 1 at the irrational time √½, and above 1 at all
/// other times. The triangle is degenerate.
constexpr std::array<double, 24> touching_at_an_irrational_time{0, 0.5, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0,
                                                                1, 0.5, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0};

/// The statements that the lines of a certificate prove.
std::vector<Statement> proved(const std::string& text) {
  std::vector<Statement> statements;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) statements.push_back(certificates::check(line));
  return statements;
}

/// A statement about a vertex and a triangle over the times [from, to], or over [from, to) if `open` is true.
Statement about(Coordinates x, double h, const char* claim, bool strict, double from = 0, double to = 1,
                bool open = false) {
  return {.kind = "vt",
          .x = {x.begin(), x.end()},
          .h = h,
          .claim = claim,
          .from = from,
          .to = to,
          .open = open,
          .strict = strict};
}

std::string certified(Coordinates x, double h, Prove what) {
  return certificate(Kind::vertex_triangle, x, h, what);
}

TEST(InterfaceCertificate, ProvesTheDecision) {
  const auto hits = falling(-1);
  EXPECT_THAT(proved(certified(hits, 0, Prove::decision)), ElementsAre(about(hits, 0, "meets", false)));
  EXPECT_THAT(proved(certified(hits, 0.5, Prove::decision)), ElementsAre(about(hits, 0.5, "meets", true)));
  const auto misses = falling(0.5);
  EXPECT_THAT(proved(certified(misses, 0, Prove::decision)), ElementsAre(about(misses, 0, "apart", true)));
  EXPECT_THAT(proved(certified(misses, 0.25, Prove::decision)),
              ElementsAre(about(misses, 0.25, "apart", true)));
  EXPECT_THAT(proved(certified(misses, 0.5, Prove::decision)),  // a tie at t = 1
              ElementsAre(about(misses, 0.5, "meets", false)));
}

TEST(InterfaceCertificate, ProvesTheEarliestTime) {
  for (const double h : {0.0, 0.1}) {
    const auto x = falling(-2);
    const Interval t = earliest_time(Kind::vertex_triangle, x, h);
    ASSERT_LT(t.lo, t.hi);
    EXPECT_THAT(proved(certified(x, h, Prove::time)), ElementsAre(about(x, h, "apart", true, 0, t.lo, true),
                                                                  about(x, h, "meets", false, t.lo, t.hi)));
  }
  const auto touches_at_first = falling(2);
  EXPECT_THAT(proved(certified(touches_at_first, 1, Prove::time)),
              ElementsAre(about(touches_at_first, 1, "meets", false, 0, 0)));
  const auto misses = falling(0.5);
  EXPECT_THAT(proved(certified(misses, 0, Prove::time)), ElementsAre(about(misses, 0, "apart", true)));
}

TEST(InterfaceCertificate, ProvesTheSmallestDistanceWhateverTheSeparation) {
  const auto misses = falling(1. / 3);
  const Interval d = smallest_distance(Kind::vertex_triangle, misses);
  const auto hits = falling(-1);
  for (const double h : {0.0, 0.5, -1.0, nan}) {
    EXPECT_THAT(proved(certified(misses, h, Prove::distance)),
                ElementsAre(about(misses, d.lo, "apart", false), about(misses, d.hi, "meets", false)))
        << h;
    EXPECT_THAT(proved(certified(hits, h, Prove::distance)), ElementsAre(about(hits, 0, "meets", false)))
        << h;
  }
}

TEST(InterfaceCertificate, LeavesOutStatementsThatHaveNoProof) {
  constexpr auto& x = touching_at_an_irrational_time;
  constexpr double h = 1;
  ASSERT_EQ(collides(Kind::vertex_triangle, x, h), Answer::collision);
  EXPECT_EQ(certified(x, h, Prove::decision), "");
  const Interval t = earliest_time(Kind::vertex_triangle, x, h);
  EXPECT_THAT(proved(certified(x, h, Prove::time)), ElementsAre(about(x, h, "apart", true, 0, t.lo, true)));
  std::string text = "#";
  EXPECT_EQ(certificate(Queries::packed(Kind::vertex_triangle, x).with_separation(h), 0, text), Status::ok);
  EXPECT_EQ(text, "");
}

/// A mesh of floats with two queries that have different separations. The second query has the vertices of
/// the first one in reverse order.
TEST(InterfaceCertificate, IsThatOfOneQueryInAnyLayout) {
  const auto falls = falling(-1);
  const std::vector<float> start(falls.begin(), falls.begin() + 12), end(falls.begin() + 12, falls.end());
  const std::vector<std::int32_t> vertices{0, 1, 2, 3, 3, 2, 1, 0};
  const std::array h{0.0, 0.125};
  const Queries mesh = Queries::of_mesh(Kind::vertex_triangle, vertices, start.data(), end.data());
  std::array<double, 24> turned{};
  for (std::size_t point = 0; point < 8; ++point)
    std::copy_n(&falls[3 * (point / 4 * 4 + 3 - point % 4)], 3, &turned[3 * point]);
  for (const Prove what : all_proofs) {
    std::string text;
    EXPECT_EQ(certificate(mesh.with_separations(h), 0, text, what), Status::ok);
    EXPECT_EQ(text, certified(falls, 0, what));
    EXPECT_EQ(certificate(mesh.with_separations(h), 1, text, what), Status::ok);
    EXPECT_EQ(text, certified(turned, 0.125, what));
    EXPECT_FALSE(proved(text).empty());
  }
}

TEST(InterfaceCertificate, IsCutOffAsBySnprintf) {
  const auto x = falling(-2);
  const nearmiss_queries query = nearmiss_packed(NEARMISS_VERTEX_TRIANGLE, 1, x.data());
  for (const Prove each : all_proofs) {
    const std::string whole = certified(x, 0, each);
    const int what = static_cast<int>(each);
    std::size_t length = 0;
    EXPECT_EQ(nearmiss_certificate(&query, 0, what, nullptr, 0, &length), NEARMISS_OK);
    EXPECT_EQ(length, whole.size());
    const std::size_t all = whole.size() + 1;
    for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{2}, all - 1, all, all + 1}) {
      std::string text(all + 2, '#');
      length = 0;
      EXPECT_EQ(nearmiss_certificate(&query, 0, what, text.data(), size, &length), NEARMISS_OK);
      EXPECT_EQ(length, whole.size());
      std::string expected = size == 0 ? "" : whole.substr(0, size - 1) + '\0';
      expected.resize(all + 2, '#');
      EXPECT_EQ(text, expected) << size;
    }
  }
}

/// Two edges pass each other at a distance that is tiny compared with their lengths.
TEST(InterfaceCertificate, IsAsLongAsItMustBe) {
  constexpr std::array x{1., -2., -0x1p1022, -2., -3., -0x1p1023, 0., 1., -0x1p1023, 2., -2., 0x1p1022,
                         1., 2.,  -0x1p1023, 3.,  -3., -0x1p1023, 0., 1., -0x1p1023, 3., -2., 0x1p1022};
  const std::string text = certificate(Kind::edge_edge, x, 0, Prove::distance);
  EXPECT_GT(text.size(), 10'000);
  EXPECT_EQ(proved(text).size(), 2);
}

TEST(InterfaceCertificate, IsEmptyIfThereIsNoAnswer) {
  auto x = falling(-1);
  x[7] = nan;
  for (const Prove what : all_proofs) {
    std::string text = "#";
    EXPECT_EQ(certificate(Queries::packed(Kind::vertex_triangle, x), 0, text, what), Status::not_finite);
    EXPECT_EQ(text, "");
  }
  const nearmiss_queries query = nearmiss_packed(NEARMISS_VERTEX_TRIANGLE, 1, x.data());
  std::string text = "##";
  std::size_t length = 7;
  EXPECT_EQ(nearmiss_certificate(&query, 0, 0, text.data(), 2, &length), NEARMISS_NOT_FINITE);
  EXPECT_EQ(length, 0);
  EXPECT_EQ(text, std::string("\0#", 2));
  const auto falls = falling(-1);
  for (const double h : {-1.0, nan, -std::numeric_limits<double>::denorm_min()}) {
    const Queries queries = Queries::packed(Kind::vertex_triangle, falls).with_separation(h);
    EXPECT_EQ(certificate(queries, 0, text), Status::not_finite) << h;
    EXPECT_EQ(certificate(queries, 0, text, Prove::time), Status::not_finite) << h;
  }
}

TEST(InterfaceCertificate, RefusesArgumentsAndWritesNothing) {
  const auto x = falling(-1);
  const nearmiss_queries good = nearmiss_packed(NEARMISS_VERTEX_TRIANGLE, 2, x.data());
  nearmiss_queries of_no_kind = good;
  of_no_kind.kind = 3;
  nearmiss_queries of_no_type = good;
  of_no_type.type = 2;
  nearmiss_queries without_end = good;
  without_end.end = nullptr;
  std::string text = "##";
  std::size_t length = 7;
  const auto expect_refused = [&](const nearmiss_queries* queries, std::size_t q, int what) {
    EXPECT_EQ(nearmiss_certificate(queries, q, what, text.data(), 2, &length), NEARMISS_BAD_ARGUMENT);
    EXPECT_EQ(text, "##");
    EXPECT_EQ(length, 7);
  };
  for (const auto* queries : {&of_no_kind, &of_no_type, &without_end}) expect_refused(queries, 0, 0);
  expect_refused(nullptr, 0, 0);
  for (const std::size_t q : {std::size_t{2}, ~std::size_t{0}}) expect_refused(&good, q, 0);
  for (const int what : {-1, 3}) expect_refused(&good, 0, what);
  EXPECT_EQ(nearmiss_certificate(&good, 0, 0, nullptr, 2, &length), NEARMISS_BAD_ARGUMENT);
  EXPECT_EQ(nearmiss_certificate(&good, 0, 0, text.data(), 2, nullptr), NEARMISS_BAD_ARGUMENT);
  EXPECT_EQ(text, "##");
  EXPECT_EQ(length, 7);
  const Queries one = Queries::packed(Kind::vertex_triangle, x);
  EXPECT_EQ(certificate(one, 1, text), Status::bad_argument);
  const Queries none = Queries::packed(Kind::vertex_triangle, std::span<const double>());
  EXPECT_EQ(certificate(none, 0, text), Status::bad_argument);
  EXPECT_EQ(certificate(one.with_separations(std::array{0.0, 0.0}), 0, text), Status::bad_argument);
}

TEST(InterfaceCertificate, IsTheSameInEveryModeOfTheProcessorAndRestoresIt) {
  constexpr double tiny = 0x1p-1070;
  constexpr double negative = -std::numeric_limits<double>::denorm_min();
  auto x = falling(-2);
  for (double& each : x) each *= tiny;
  for (const Prove what : all_proofs) {
    const std::string expected = certified(x, tiny / 8, what);
    EXPECT_FALSE(proved(expected).empty());
    for (const int rounding : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
      const testing::HostileArithmetic mode(rounding, true);
      const std::string before = odd_arithmetic();
      const std::string text = certified(x, tiny / 8, what);
      const Queries of_negative_h = Queries::packed(Kind::vertex_triangle, x).with_separation(negative);
      std::string none;
      const Status status = certificate(of_negative_h, 0, none);
      EXPECT_EQ(odd_arithmetic(), before);
      EXPECT_EQ(status, Status::not_finite) << before;
      EXPECT_EQ(text, expected) << before;
    }
  }
}

TEST(InterfaceCertificate, IsTheSameInEveryThread) {
  constexpr int count = 200;
  const auto ask = [](std::vector<std::string>& texts) {
    for (int i = 0; i < count; ++i)
      texts.push_back(
          certified(falling(1. / 3 - 0.01 * i), 0.01, all_proofs[static_cast<std::size_t>(i) % 3]));
  };
  std::vector<std::string> expected;
  ask(expected);
  std::array<std::vector<std::string>, 3> found;
  std::vector<std::thread> threads;
  for (auto& texts : found) threads.emplace_back(ask, std::ref(texts));
  for (std::thread& each : threads) each.join();
  EXPECT_THAT(found, ::testing::Each(expected));
}

}  // namespace
}  // namespace nearmiss
