// The filter (in double words) and exact arithmetic find the same two neighbouring doubles around the
// earliest time of contact.
#include "oracle/filter/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/gmp.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "oracle/arithmetic/ball.hpp"
#include "oracle/distance/crossing.hpp"
#include "oracle/filter/filter.hpp"
#include "oracle/oracle.hpp"
#include "tests/exact_times.hpp"
#include "tests/oracle/hard_queries.hpp"
#include "tests/queries.hpp"
#include "tests/random_queries.hpp"

namespace nearmiss {
namespace {

using certified::Ball;
using certified::DoubleWord;
using Rational = boost::multiprecision::mpq_rational;
using testing::Hard;

TEST(Neighbours, OfANumberAreTheDoublesAroundIt) {
  for (std::size_t i = 0; i < 20000; ++i) {
    Hard hard(21, i);
    const double power = std::ldexp(1.0, hard.integer(-1000, 0));
    const double x = i % 4 == 0   ? power
                     : i % 4 == 1 ? std::nextafter(power, 2)
                     : i % 4 == 2 ? std::nextafter(power, 0)
                                  : power * hard.uniform(1, 2);
    const double before = std::nextafter(x, 0);
    const double behind = std::nextafter(x, 2);
    const double little = (x - before) / 4;
    EXPECT_EQ(certified::doubles_around(DoubleWord(x, little)), std::pair(x, behind)) << x;
    EXPECT_EQ(certified::doubles_around(DoubleWord(x)), std::pair(x, behind)) << x;
    EXPECT_EQ(certified::doubles_around(DoubleWord(x, -little)), std::pair(before, x)) << x;
  }
  const double subnormal = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(certified::doubles_around(DoubleWord(subnormal)).second, subnormal);
}

Rational exactly(double x) { return Rational(x); }
Rational exactly(const DoubleWord& x) { return Rational(x.hi) + Rational(x.lo); }

/// A ball, and a number at the ball's centre or on its border.
template <class Real>
struct Sample {
  Ball<Real> ball;
  Rational exact;

  explicit Sample(Hard& hard) {
    const double x = std::ldexp(hard.number(), hard.integer(0, 3) == 0 ? hard.integer(-1080, -480) : 0);
    ball = {Real(x), std::abs(x) * std::ldexp(1.0, hard.integer(-110, -1))};
    exact = Rational(x) + Rational(ball.error) * hard.integer(-1, 1);
  }
};

template <class Real>
void expect_that_balls_contain_results() {
  for (std::size_t i = 0; i < 20000; ++i) {
    Hard hard(22, i);
    const Sample<Real> a(hard);
    const Sample<Real> b(hard);
    const Sample<Real> c(hard);
    const auto expect = [&](const Ball<Real>& computed, const Rational& exact) {
      EXPECT_LE(abs(exactly(computed.x) - exact), Rational(computed.error)) << i;
    };
    expect(a.ball + b.ball, a.exact + b.exact);
    expect(a.ball - b.ball, a.exact - b.exact);
    expect(a.ball * b.ball, a.exact * b.exact);
    expect(a.ball * b.ball - b.ball * c.ball + c.ball * c.ball,
           a.exact * b.exact - b.exact * c.exact + c.exact * c.exact);
    const int sign = (a.ball - b.ball).sign();
    if (sign != 0) {
      EXPECT_EQ(sign, a.exact < b.exact ? -1 : 1) << i;
    }
  }
}

TEST(Ball, ContainsTheResultsOfExactArithmetic) {
  expect_that_balls_contain_results<double>();
  expect_that_balls_contain_results<DoubleWord>();
}

TEST(Ball, HasNoSignIfItOverflows) {
  const Ball<double> huge(0x1p1000);
  EXPECT_EQ((huge * huge).sign(), 0);
  EXPECT_EQ((Ball<DoubleWord>(0x1p1000) * Ball<DoubleWord>(0x1p1000)).sign(), 0);
}

/// Whether the ends of `time` are neighbouring doubles with the exact time `first` between them.
::testing::AssertionResult is_between(exact::Root first, const Enclosure& time) {
  exact::Root lo{exact::Number(time.lo)};
  if (std::nextafter(time.lo, 2) == time.hi && lo.is_below(first) && testing::is_before(first, time.hi))
    return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "not between " << std::hexfloat << time.lo << " and " << time.hi;
}

/// Random queries, some of which collide.
std::vector<Query> contacts(std::uint64_t seed, std::size_t count) {
  std::vector<Query> queries;
  for (std::size_t i = 0; i < count; ++i) {
    Random random(seed, 1, i);
    queries.push_back(i % 2 == 0 ? Hard(seed, i).query()
                                 : testing::uniform_query(random, testing::kind_of_case(i / 2)));
  }
  return queries;
}

/// Compares each time in `times` that the filter knows with the exact time. Returns the number of these
/// comparisons.
std::size_t check(const std::vector<Query>& queries, const std::vector<KnownTime>& times) {
  std::size_t known = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    if (!times[i].is_known_to(0)) continue;
    auto exactly = testing::exact_times(queries[i]);
    if (!exactly) continue;
    ++known;
    if (times[i].is_between)
      EXPECT_TRUE(is_between(exactly->time, times[i].time)) << testing::repeat(i, queries[i]);
    else
      EXPECT_TRUE(exactly->time.is(exact::Number(times[i].time.lo))) << testing::repeat(i, queries[i]);
  }
  return known;
}

TEST(Neighbours, OfTheFirstContactAreThoseOfExactArithmetic) {
  const auto queries = contacts(23, 40000);
  std::vector<FilterStage> stages(queries.size());
  std::vector<KnownTime> times(queries.size());
  for (std::size_t i = 0; i < queries.size(); ++i) {
    stages[i] = filter_for_time(queries[i], times[i]);
    EXPECT_TRUE(stages[i] == FilterStage::undecided || is_collision(stages[i]) == collides(queries[i]))
        << testing::repeat(i, queries[i]);
  }
  const std::size_t of_one = check(queries, times);
  EXPECT_GT(of_one, queries.size() / 20);
  for (const Instructions instructions : all_instructions) {
    if (!has(instructions)) continue;
    filter_for_times(QueryRows(queries), stages, times, instructions);
    EXPECT_GT(check(queries, times), of_one * 9 / 10) << lanes(instructions);
  }
}

// The first contact is less than 2^-200 before t = 1/4. At 1/4 and at the next double, the signs of F, whose
// roots are the times at which the vertices are coplanar, do not show whether the contact is before 1/4.
TEST(Neighbours, AreNotFoundAroundADoubleNextToTheRoot) {
  const Query query{.kind = Kind::vertex_triangle,
                    .x = {0,
                          0,
                          -0x1p+74,
                          -0x1.39p+44,
                          0x1.6c78p+374,
                          -0x1.8p+26,
                          0x1.f340000000002p-107,
                          -0x1.5387ffffffffep+221,
                          0x1.228p-118,
                          -0x1.108p+75,
                          -0x1.8c4p+401,
                          -0x1.80fffffffffffp+63,
                          0,
                          0,
                          0x1.8p+75,
                          -0x1.aap+43,
                          0x1.7298p+374,
                          0x1.2p+28,
                          0x1.032p-106,
                          -0x1.4d67fffffffffp+221,
                          0x1.188p-118,
                          -0x1.0e8p+75,
                          -0x1.9b4p+401,
                          -0x1.7dp+63}};
  KnownTime time;
  filter_for_time(query, time);
  EXPECT_FALSE(time.is_known_to(0));
  EXPECT_EQ(earliest_time(query)->enclosure(), (Enclosure{0x1.fffffffffffffp-3, 0x1p-2}));
}

TEST(Neighbours, OfTheFirstTimeWithinASeparationAreThoseOfExactArithmetic) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < 6000; ++i) {
    Random random(24, 0, i);
    Query query = testing::uniform_query(random, kinds[i % kinds.size()]);
    repeat_vertices(query);
    query.separation = std::ldexp(random.uniform(1, 2), random.integer(-30, -2));
    const KnownApproach known = known_approach(query, rough_time);
    if (known.stage != FilterStage::within) continue;
    const auto neighbours = certified::narrow_crossing(query, known.time);
    if (!neighbours) continue;
    ++found;
    EXPECT_TRUE(is_between(testing::exact_times(query)->time, *neighbours)) << testing::repeat(i, query);
    EXPECT_TRUE(is_between(*testing::exact_times(query)->below, *neighbours)) << testing::repeat(i, query);
  }
  EXPECT_GT(found, 500U);
}

}  // namespace
}  // namespace nearmiss
