// Subjects over scalars other than double.
#include "fuzz/subjects/ladder/scalars.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/gmp.hpp>
#include <limits>
#include <set>

#include "ccd/query/scalar_name.hpp"
#include "ccd/wang/tolerances.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/random.hpp"
#include "fuzz/subjects/ladder/adaptive.hpp"
#include "fuzz/subjects/ladder/double_double.hpp"
#include "fuzz/subjects/ladder/mpfr_float.hpp"
#include "fuzz/trial/judge.hpp"
#include "oracle/oracle.hpp"
#include "tests/fuzz/trials.hpp"
#include "tests/queries.hpp"
#include "tests/refused.hpp"

namespace nearmiss {
namespace {

namespace mp = boost::multiprecision;
using Rational = mp::mpq_rational;

Rational exactly(const DoubleDouble& a) { return Rational(a.value().x[0]) + Rational(a.value().x[1]); }

/// The relative error of a result, in units of double-double's ε, 2^-102.
double error(const DoubleDouble& computed, const Rational& exact) {
  if (exact == 0) return exactly(computed) == 0 ? 0 : std::numeric_limits<double>::infinity();
  const Rational relative = abs((exactly(computed) - exact) / exact);
  return static_cast<double>(relative) * 0x1p102;
}

/// Two double-doubles. Often, they nearly cancel: their sum is far smaller than both.
std::pair<DoubleDouble, DoubleDouble> operands(Random& random) {
  const auto draw = [&] {
    const double high = random.uniform(-1, 1);
    const double low = random.uniform(-1, 1) * 0x1p-54;
    return DoubleDouble(high) + DoubleDouble(high * low);
  };
  const DoubleDouble a = draw();
  DoubleDouble b = draw();
  if (random.one_in(2)) b = -a * DoubleDouble(1 + random.uniform(-1, 1) * 0x1p-60);
  if (random.one_in(3)) b = ldexp(b, random.integer(-60, 60));
  return {a, b};
}

TEST(DoubleDouble, EveryOperationIsWithinItsEpsilon) {
  Random random(1, 0, 0);
  double sum = 0;
  double product = 0;
  double quotient = 0;
  double root = 0;
  for (int i = 0; i < 50000; ++i) {
    const auto [a, b] = operands(random);
    sum = std::max(sum, error(a + b, exactly(a) + exactly(b)));
    sum = std::max(sum, error(a - b, exactly(a) - exactly(b)));
    product = std::max(product, error(a * b, exactly(a) * exactly(b)));
    quotient = std::max(quotient, error(a / b, exactly(a) / exactly(b)));
    // The relative error of a root is half of the relative error that the square of the root has.
    const DoubleDouble r = sqrt(abs(a));
    root = std::max(root, error(r * r, abs(exactly(a))) / 2);
  }
  EXPECT_LE(sum, 3.0 / 16 + 1e-9);
  EXPECT_LE(product, 5.0 / 16);
  EXPECT_LE(quotient, 1);
  EXPECT_LE(root, 1);
  EXPECT_GT(sum, 1.0 / 16);
}

TEST(MpfrFloat, AreThoseOfTheScope) {
  const MpfrFloat::PrecisionScope outer(20);
  EXPECT_EQ(static_cast<double>(epsilon<MpfrFloat>()), 0x1p-19);
  {
    const MpfrFloat::PrecisionScope inner(200);
    EXPECT_EQ(static_cast<double>(epsilon<MpfrFloat>()), 0x1p-199);
    EXPECT_NE(MpfrFloat(1) + 0x1p-150, MpfrFloat(1));
  }
  EXPECT_EQ(MpfrFloat(1) + 0x1p-25, MpfrFloat(1));
  EXPECT_EQ(ilogb(MpfrFloat(-5)), 2);
  EXPECT_EQ(static_cast<double>(abs(MpfrFloat(-0.1))), 0x1.9999ap-4);
  // The quotient is rounded to nearest, as are the results of all operations.
  EXPECT_EQ(static_cast<double>(MpfrFloat(1) / 3), 0x1.55556p-2);
  EXPECT_EQ(static_cast<double>(MpfrFloat(1) - 0x1.8p-20), 1 - 0x1p-19);
  EXPECT_EQ(static_cast<double>(MpfrFloat(3) * 0x1.55556p-2), 1);
  EXPECT_EQ(static_cast<double>(sqrt(MpfrFloat(2))), 0x1.6a09ep0);
  EXPECT_FALSE(isfinite(MpfrFloat(std::numeric_limits<double>::infinity())));
  const MpfrFloat not_a_number = MpfrFloat(0) / MpfrFloat(0);
  EXPECT_FALSE(not_a_number == not_a_number || not_a_number <= 0 || not_a_number >= 0);
  EXPECT_TRUE(not_a_number != not_a_number);
}

TEST(Scalars, AreKnownByName) {
  std::vector<std::string> names{"p16", "p17", "p255", "p256"};
  int before = 0;
  for (const auto& scalar : named_scalars()) {
    EXPECT_LE(scalar.epsilon_exponent, before);
    before = scalar.epsilon_exponent;
    EXPECT_EQ(epsilon_exponent_of(scalar.name), scalar.epsilon_exponent);
    names.push_back(scalar.name);
  }
  for (const std::string& name : names) EXPECT_EQ(make_any_subject("wang:" + name)->name(), "wang:" + name);
  for (const char* none : {"wang:p15", "wang:p257", "wang:p40x", "wang:p", "wang:half"})
    EXPECT_REFUSED(make_any_subject(none), "a scalar behind the colon: float, double, ");
  EXPECT_REFUSED(make_any_subject("exact:float"), "expected basic, wang");
  const Query query = testing::falling_vertex(0.25, 0.25, 1, -1);
  const auto bound = [&](const char* name) { return make_any_subject(name)->distance_bound(query); };
  EXPECT_NEAR(bound("wang:p53@7"), bound("wang@7"), 1e-9);
  EXPECT_NEAR(bound("wang-tight:dd@7"), 11.9335 * 7 * std::pow(2, -25.5), 1e-9);
}

std::vector<Batch> batches(std::uint64_t seed, std::uint64_t count) {
  std::vector<Batch> all;
  for (const Family& family : families())
    for (const std::uint64_t first : {0U, 1U}) {
      std::vector<Query> queries;
      for (std::uint64_t i = first; i < 2 * count; i += 2) queries.push_back(make_query(family, seed, i));
      all.push_back(testing::batch_of(family.name, queries));
    }
  return all;
}

class EveryScalar : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Ladder, EveryScalar, ::testing::ValuesIn([] {
                           std::vector<std::string> names{"p16",  "p17",  "p24",  "p40",
                                                          "p100", "p150", "p256", "dd-normals"};
                           for (const auto& scalar : named_scalars()) names.push_back(scalar.name);
                           return names;
                         }()),
                         [](const auto& scalar) {
                           std::string name = scalar.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST_P(EveryScalar, MissesNothingAndReportsNothingBeyondItsBound) {
  const Subjects subjects = testing::one(make_any_subject("wang-tight:" + GetParam()));
  const bool is_fast = GetParam() == "double" || GetParam() == "float";
  TrialResult sum;
  for (const Batch& batch : batches(7, is_fast ? 1000 : 30)) sum.merge(hold_trial(subjects, batch));
  std::uint64_t collisions = 0;
  for (const auto& [key, counts] : sum.statistics.counts) {
    collisions += counts.collisions;
    EXPECT_LE(counts.max_ratio(), 1) << key.family;
    EXPECT_EQ(counts.refuted_bounds, 0) << key.family;
  }
  EXPECT_GT(collisions, 500);
  EXPECT_EQ(sum.statistics.false_negatives(), 0);
  EXPECT_EQ(sum.statistics.faults(), 0);
}

TEST(Ladder, The53BitsOfDoubleAnswerAsDoubleDoes) {
  const auto in_double = make_any_subject("wang");
  const auto by_template = make_any_subject("wang:double");
  const auto by_bits = make_any_subject("wang:p53");
  for (const Batch& batch : batches(3, 50))
    for (const Query& query : batch.queries) {
      const bool hit = in_double->decide(query).hit;
      ASSERT_EQ(by_template->decide(query).hit, hit) << batch.family;
      if (batch.family == "uniform" || batch.family == "sliver" || batch.family == "parallel") {
        ASSERT_EQ(by_bits->decide(query).hit, hit) << batch.family;
      }
    }
}

TEST(Ladder, ANarrowScalarIsJudgedByTheRoundedQuery) {
  // The vertex ends above the triangle, by less than an ulp of float.
  const Query query = testing::falling_vertex(0.25, 0.25, 1, 0x1p-40);
  const Query moved = testing::moved(query, 1);
  ASSERT_FALSE(collides(moved));
  const auto subject = make_any_subject("basic:float");
  EXPECT_TRUE(subject->rounds());
  const Query rounded = subject->rounded(moved);
  EXPECT_TRUE(collides(rounded));
  EXPECT_EQ(subject->rounded(rounded).x, rounded.x);
  EXPECT_FALSE(make_any_subject("basic:dd")->rounds());

  const TrialResult result =
      hold_trial(testing::subjects_named({"wang:float", "wang"}), testing::batch_of("f", {moved}));
  const auto& counts = result.statistics.counts;
  EXPECT_EQ(counts.at({"wang:float", query.kind, "f"}).collisions, 1);
  EXPECT_EQ(counts.at({"wang", query.kind, "f"}).collisions, 0);
  const auto& oracle = result.statistics.oracle.at({query.kind, "f"});
  EXPECT_EQ(oracle.queries, 1);
  EXPECT_EQ(oracle.collisions, 0);
}

// A coordinate that would round to 2^1024 becomes the scalar's largest number below 2^1024.
TEST(Ladder, NarrowScalarsRoundTheLargestNumbersToFiniteOnes) {
  constexpr double largest = std::numeric_limits<double>::max();
  const Query query =
      testing::make_query(Kind::vertex_triangle, {{largest, 0, 1}, {0, 0, 0}, {1, 0, 0}, {0, -largest, 0}},
                          {{largest, 0, -1}, {0, 0, 0}, {largest, 0, 0}, {0, largest, 0}});
  for (const char* name : {"wang:p16", "wang-tight:p24", "basic:p40", "wang:p52", "wang:float"}) {
    const auto subject = make_any_subject(name);
    const Query rounded = subject->rounded(query);
    EXPECT_TRUE(is_finite(rounded)) << name;
    EXPECT_EQ(subject->rounded(rounded), rounded) << name;
    EXPECT_EQ(subject->decide(rounded).hit, subject->decide(query).hit) << name;
    EXPECT_EQ(Judge(*subject).failure(query), std::nullopt) << name;
  }
  EXPECT_EQ(make_any_subject("wang:p16")->rounded(query).x[0], 0x1.fffep1023);
}

TEST(Adaptive, SaysWhatExactSaysAndEachOfItsStagesIsNeeded) {
  const auto adaptive = try_make_adaptive("adaptive");
  std::set<Stage> accepted;
  std::set<Rejection> rejected;
  for (const Batch& batch : batches(5, 200)) {
    std::vector<Verdict> verdicts(batch.queries.size());
    adaptive->decide(batch.queries, verdicts);
    for (std::size_t i = 0; i < verdicts.size(); ++i) {
      ASSERT_EQ(verdicts[i].hit, collides(batch.queries[i])) << batch.family << ' ' << i;
      ASSERT_EQ(adaptive->decide(batch.queries[i]).hit, verdicts[i].hit);
      if (verdicts[i].hit)
        accepted.insert(verdicts[i].stage);
      else
        rejected.insert(verdicts[i].rejection);
    }
  }
  EXPECT_EQ(accepted, (std::set{Stage::filter, Stage::exact}));
  for (const Rejection rejection : {Rejection::planes, Rejection::no_root, Rejection::culled,
                                    Rejection::tests, Rejection::filter, Rejection::finer, Rejection::exact})
    EXPECT_TRUE(rejected.contains(rejection)) << rejection_names[static_cast<std::size_t>(rejection)];
}

}  // namespace
}  // namespace nearmiss
