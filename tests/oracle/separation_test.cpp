// Checks, in rational arithmetic, the errors of the certified distance bounds.
#include "oracle/distance/separation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/gmp.hpp>
#include <cmath>
#include <vector>

#include "oracle/distance/moment.hpp"
#include "oracle/distance/wide.hpp"
#include "oracle/exact/nearness.hpp"
#include "tests/random_queries.hpp"

namespace nearmiss::certified {

/// A scalar that counts roundings. Each value stands for a sum of products; its `count` is the largest number
/// of roundings of any of these products. A difference of vertices, which VertexDifferences stores as a sum
/// of two doubles, counts as one rounding.
struct RoundingCount {
  int count = 0;

  RoundingCount() = default;
  explicit RoundingCount(double /*exact*/) {}
  static RoundingCount of(int roundings) {
    RoundingCount r;
    r.count = roundings;
    return r;
  }
  explicit operator double() const { return count; }

  friend RoundingCount operator+(const RoundingCount& a, const RoundingCount& b) {
    return of(std::max(a.count, b.count) + 1);
  }
  friend RoundingCount operator-(const RoundingCount& a, const RoundingCount& b) { return a + b; }
  friend RoundingCount operator*(const RoundingCount& a, const RoundingCount& b) {
    return of(a.count + b.count + 1);
  }
  friend RoundingCount operator-(const RoundingCount& a) { return a; }
};
template <>
inline constexpr double roundoff<RoundingCount> = 1;

namespace {

using Rational = boost::multiprecision::mpq_rational;
using ExactVector = std::array<Rational, 3>;

/// The exact vertices of a query at a time t, in the unit of `differences`.
class ExactVertices {
 public:
  ExactVertices(const Query& query, const VertexDifferences& differences, const Rational& t)
      : query_(query), t_(t) {
    const int exponent = differences.exponent();
    for (int i = 0; i < std::abs(exponent); ++i) unit_ *= exponent > 0 ? Rational(2) : Rational(1, 2);
  }

  [[nodiscard]] ExactVector position(std::size_t i, std::size_t j) const {
    return difference(i, j, [&](const Rational& start, const Rational& end) {
      return Rational((1 - t_) * start + t_ * end);
    });
  }
  [[nodiscard]] ExactVector velocity(std::size_t i, std::size_t j) const {
    return difference(i, j, [](const Rational& start, const Rational& end) { return Rational(end - start); });
  }

 private:
  template <class Formula>
  [[nodiscard]] ExactVector difference(std::size_t i, std::size_t j, const Formula& formula) const {
    ExactVector v;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = [&](std::size_t time) {
        return Rational(Rational(query_.x[12 * time + 3 * i + k]) -
                        Rational(query_.x[12 * time + 3 * j + k]));
      };
      v[k] = formula(at(0), at(1)) / unit_;
    }
    return v;
  }

  const Query& query_;
  Rational t_, unit_ = 1;
};

ExactVector cross(const ExactVector& v, const ExactVector& w) {
  return {Rational(v[1] * w[2] - v[2] * w[1]), Rational(v[2] * w[0] - v[0] * w[2]),
          Rational(v[0] * w[1] - v[1] * w[0])};
}
Rational dot(const ExactVector& v, const ExactVector& w) { return v[0] * w[0] + v[1] * w[1] + v[2] * w[2]; }
ExactVector exactly(const Vec<double>& v) { return {Rational(v[0]), Rational(v[1]), Rational(v[2])}; }

/// Queries of several sorts. Some have coordinates of one magnitude, others have coordinates of different
/// magnitudes. In some, the coordinates are so large that differences overflow, or so small that products
/// underflow.
std::vector<Query> all_sorts(std::size_t each) {
  std::vector<Query> queries;
  for (const auto& [smallest, largest] :
       {std::pair{0, 0}, {-60, 0}, {-1040, -1000}, {1000, 1023}, {-300, 300}, {-1070, 1023}}) {
    for (std::size_t i = 0; i < each; ++i) {
      Random random(20, static_cast<std::uint64_t>(smallest), i);
      Query query = testing::uniform_query(random, testing::kind_of_case(i));
      for (double& c : query.x) c = std::ldexp(c, random.integer(smallest, largest));
      queries.push_back(query);
    }
  }
  return queries;
}

/// Expects that the error of every coefficient is at most the coefficient's error bound. Returns the largest
/// quotient of an error and its bound.
double expect_within(const Product& product, const std::array<Rational, 4>& exact) {
  double most = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Rational miss = abs(Rational(product.coefficients[i]) - exact[i]);
    const double share = Rational(miss / Rational(product.errors[i])).convert_to<double>();
    EXPECT_LE(share, 1) << "coefficient " << i;
    most = std::max(most, share);
  }
  return most;
}

template <class Real>
struct SeparationErrors : ::testing::Test {};
using Reals = ::testing::Types<double, DoubleWord, Wide>;
TYPED_TEST_SUITE(SeparationErrors, Reals);

/// A number with random bits, and with any exponent that a difference of vertices may have.
Wide random_wide(Random& random) {
  Wide x = 1;
  for (int i = 0; i < 6; ++i) x = ldexp(x, 64) + Wide(random.bits());
  x = ldexp(x, random.integer(-1400, 599));
  return random.one_in(2) ? x : -x;
}

TEST(WideNumbers, RoundSumsAndProductsAndDoublesAsErrorsAssume) {
  const auto expect_near = [](const Rational& found, const Rational& exact, unsigned digits) {
    EXPECT_LE(Rational(abs(found - exact) * Rational(boost::multiprecision::mpz_int(1) << digits)),
              abs(exact));
  };
  for (std::size_t i = 0; i < 2000; ++i) {
    Random random(8, 0, i);
    const Wide x = random_wide(random), y = random_wide(random);
    SCOPED_TRACE(::testing::Message() << "case " << i << ": " << x << " and " << y);
    const Wide near = -x * (1 + ldexp(Wide(1), -random.integer(0, 399)));
    const Rational exact_x(x), exact_y(y);
    expect_near(Rational(Wide(x * y)), Rational(exact_x * exact_y), 384U);
    expect_near(Rational(Wide(x + y)), Rational(exact_x + exact_y), 384U);
    expect_near(Rational(Wide(x + near)), Rational(exact_x + Rational(near)), 384);
    const double rounded = to_double(x);
    if (std::isnormal(rounded)) expect_near(Rational(rounded), exact_x, 53);
  }
}

TYPED_TEST(SeparationErrors, NormalsProductsAreWithinTheirErrors) {
  for (const Query& query : all_sorts(60))
    for (const double t : {0.0, 0.3, 1.0}) {
      const VertexDifferences differences(query);
      const Separation separation = separate_by_normal(VerticesAt<TypeParam>(differences, TypeParam(t)));
      const ExactVertices x(query, differences, Rational(t));
      const bool triangle = query.kind == Kind::vertex_triangle;
      const std::size_t origin = triangle ? 1 : 2;
      const std::size_t q_to = triangle ? 2 : 0;
      const ExactVector q = x.position(q_to, 1), r = x.position(3, origin), p = x.position(0, origin);
      const ExactVector v = x.velocity(q_to, 1), w = x.velocity(3, origin), u = x.velocity(0, origin);
      std::array<Rational, 4> F{Rational(dot(cross(q, r), p)),
                                Rational(dot(cross(v, r), p) + dot(cross(q, w), p) + dot(cross(q, r), u)),
                                Rational(dot(cross(v, w), p) + dot(cross(v, r), u) + dot(cross(q, w), u)),
                                Rational(dot(cross(v, w), u))};
      if ((F[0] < 0) != (separation.products[0].coefficients[0] < 0) &&
          abs(F[0]) > Rational(separation.products[0].errors[0]))
        // The computed distance has the opposite sign, because the normal has the opposite direction.
        for (Rational& c : F) c = -c;
      if (abs(F[0]) > Rational(separation.products[0].errors[0])) expect_within(separation.products[0], F);
      EXPECT_GE(Rational(separation.length[0]) * Rational(separation.length[0]),
                dot(cross(q, r), cross(q, r)));
    }
}

TYPED_TEST(SeparationErrors, EdgesProductsAreWithinTheirErrors) {
  const Vec<double> direction{0.6, -0.64, 0.48};
  for (const Query& query : all_sorts(60))
    for (const double t : {0.0, 0.3, 1.0}) {
      const VertexDifferences differences(query);
      const VerticesAt<TypeParam> rounded(differences, TypeParam(t));
      const Separation separation = separate_by_edge(rounded, 2, 3, direction);
      if (separation.products.empty()) continue;
      const ExactVertices x(query, differences, Rational(t));
      const Vec<double> edge = to_double(rounded.position(3, 2));
      const ExactVector k = exactly((1 / certified::dot(edge, edge)) * certified::cross(direction, edge));
      const ExactVector n0 = cross(x.position(3, 2), k), n1 = cross(x.velocity(3, 2), k);
      EXPECT_GE(Rational(separation.length[0]) * Rational(separation.length[0]), dot(n0, n0));
      EXPECT_GE(Rational(separation.length[1]) * Rational(separation.length[1]), dot(n1, n1));
      std::size_t count = 0;
      for (std::size_t i = 0; i < second_primitive(query.kind); ++i)
        for (std::size_t j = second_primitive(query.kind); j < 4; ++j) {
          if (j == 3) continue;
          const ExactVector p = x.position(i, j), w = x.velocity(i, j);
          ASSERT_LT(count, separation.products.size());
          expect_within(
              separation.products[count++],
              {Rational(dot(n0, p)), Rational(dot(n0, w) + dot(n1, p)), Rational(dot(n1, w)), Rational(0)});
        }
      EXPECT_EQ(count, separation.products.size());
    }
}

TYPED_TEST(SeparationErrors, ConstantsProductsAreWithinTheirErrors) {
  const Vec<double> direction{0.6, -0.64, 0.48};
  for (const Query& query : all_sorts(60)) {
    const VertexDifferences differences(query);
    const Separation separation =
        separate_by_constant(VerticesAt<TypeParam>(differences, TypeParam(0.3)), direction);
    const ExactVertices x(query, differences, Rational(0.3));
    std::size_t count = 0;
    for (std::size_t i = 0; i < second_primitive(query.kind); ++i)
      for (std::size_t j = second_primitive(query.kind); j < 4; ++j)
        expect_within(separation.products[count++],
                      {Rational(dot(exactly(direction), x.position(i, j))),
                       Rational(dot(exactly(direction), x.velocity(i, j))), Rational(0), Rational(0)});
    EXPECT_EQ(count, separation.products.size());
  }
}

TYPED_TEST(SeparationErrors, UpperBoundsAreAboveTheDistance) {
  for (const Query& query : all_sorts(10))
    for (const double t : {0.0, 0.3, 1.0}) {
      const VertexDifferences differences(query);
      const Moment moment = look(VerticesAt<TypeParam>(differences, TypeParam(t)));
      const double upper = std::ldexp(moment.upper, differences.exponent());
      if (std::isfinite(upper)) {
        EXPECT_TRUE(comes_within(query, std::nextafter(upper, HUGE_VAL))) << query.x[0];
      }
    }
}

/// Expects that the error bound of coefficient i is at least n · sizes[i], where n is the number of roundings
/// of the coefficient. The value of a coefficient is n here, because it counts roundings. sizes[i] bounds the
/// sum of the magnitudes of the products in the coefficient.
void expect_room(const Product& product, const std::array<double, 4>& sizes) {
  constexpr double second_orders = 1.02;  // this factor also covers the roundings of the computed error bound
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_GE(product.errors[i], second_orders * product.coefficients[i] * sizes[i]) << i;
}

constexpr double three_vectors = 1.154700538379252;  // 2 / √3, rounded up

TEST(Separation, ErrorsHaveRoomForAllRoundings) {
  for (const Query& query : all_sorts(6)) {
    const VertexDifferences differences(query);
    const VerticesAt<RoundingCount> x(differences, RoundingCount(0.3));
    const std::size_t second = second_primitive(query.kind);

    const Vec<double> direction{0.6, -0.64, 0.48};
    const Separation constant = separate_by_constant(x, direction);
    std::size_t n = 0;
    for (std::size_t i = 0; i < second; ++i)
      for (std::size_t j = second; j < 4; ++j) {
        const double size = length(direction) * differences.reach(i, j);
        expect_room(constant.products[n++], {size, 2 * size, 0, 0});
      }

    const bool triangle = query.kind == Kind::vertex_triangle;
    const std::size_t origin = triangle ? 1 : 2;
    const std::size_t q_to = triangle ? 2 : 0;
    const double area = three_vectors * differences.reach(q_to, 1) * differences.reach(3, origin);
    const double volume = area * differences.reach(0, origin);
    const Separation normal = separate_by_normal(x);
    expect_room(normal.products[0], {volume, 6 * volume, 12 * volume, 8 * volume});
  }
}

// This test checks only the numbers of roundings. The tests above also check the bounds of the vectors'
// lengths.
TEST(Separation, RoundingsAreThoseOfTheTableInTheHeader) {
  const Query query = all_sorts(1)[0];
  const VertexDifferences differences(query);
  const VerticesAt<RoundingCount> x(differences, RoundingCount(0.3));
  const auto counts = [](const Separation& separation) { return separation.products[0].coefficients; };
  EXPECT_EQ(counts(separate_by_constant(x, {0.6, -0.64, 0.48})), (std::array<double, 4>{7, 5, 0, 0}));
  EXPECT_EQ(counts(separate_by_edge(x, 2, 3, {0.6, -0.64, 0.48})), (std::array<double, 4>{13, 12, 9, 0}));
  EXPECT_EQ(counts(separate_by_normal(x)), (std::array<double, 4>{17, 17, 15, 11}));
}

TEST(CertifiedReach, EndsWhereAProductFallsBelowTheDistance) {
  Separation separation;
  separation.length = {2, 0, 0};
  separation.add({6, -1, 0, 0}, {});  // (6 - s) / 2 is at least 2 until s = 2
  EXPECT_EQ(certified_reach(separation, 2, 1, 1), 1);
  const double forward = certified_reach(separation, 2, 1, 8);
  EXPECT_LE(forward, 2);
  EXPECT_GT(forward, 1.99);
  EXPECT_EQ(certified_reach(separation, 2, -1, 8), 8);
  EXPECT_EQ(certified_reach(separation, 3.1, 1, 8), 0);
  separation.add({5, 0, -1, 0}, {});  // 5 - s² is 4 at s = 1
  EXPECT_LE(certified_reach(separation, 2, 1, 8), 1);
  EXPECT_LE(certified_reach(separation, 2, -1, 8), 1);
}

TEST(CertifiedReach, AnErrorOrALongerNormalEndsItSooner) {
  Separation separation;
  separation.length = {1, 0.5, 0.25};
  separation.add({4, 0, 0, 0}, {0, 0.5, 0, 0.125});
  // The product minus its errors and the length is 4 - s / 2 - s³ / 8 - 1 - s / 2 - s² / 4, which is zero at
  // s = 1.687...
  EXPECT_LE(certified_reach(separation, 1, 1, 8), 1.6875);
  EXPECT_GT(certified_reach(separation, 1, 1, 8), 1.68);
}

}  // namespace
}  // namespace nearmiss::certified
