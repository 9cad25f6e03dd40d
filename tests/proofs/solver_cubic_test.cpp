// Searches for problems that come near the bounds in the proof of solve_cubic. The coefficients are taken as
// exact, so only the errors of the solver remain: m, which the computed nodes cause, and h, which Horner's
// rule causes.
#include "ccd/wang/cubic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "tests/proofs/climb.hpp"
#include "tests/proofs/solver_orders.hpp"

namespace nearmiss::proofs {
namespace {

/// The coefficients a, b, c and d: numbers in the thread's precision, of magnitudes at most 6, 18, 18 and 6.
using Coefficients = std::array<double, 4>;
constexpr Coefficients sizes{6, 18, 18, 6};

template <class T>
Cubic<T> cubic(const Coefficients& k) {
  return {T(k[0]), T(k[1]), T(k[2]), T(k[3])};
}

/// The nodes of the solver: 0, the computed critical points, and 1.
std::vector<double> nodes_of(const Coefficients& k) {
  CandidateTimes<MpfrFloat, 2> critical;
  detail::find_critical_times(critical, cubic<MpfrFloat>(k));
  std::vector<double> nodes{0};
  for (const MpfrFloat& t : critical) nodes.push_back(static_cast<double>(t));
  nodes.push_back(1);
  return nodes;
}

/// The places to check in the interval between two nodes: the ends of the interval, and the exact critical
/// points inside the interval. (Critical points in double stand for exact ones, because the tested numbers
/// have far fewer bits.)
std::vector<double> places_between(const Coefficients& k, double left, double right) {
  CandidateTimes<double, 2> critical;
  solve_quadratic(critical, 3 * k[0], 2 * k[1], k[2]);
  std::vector<double> places{left};
  for (const double t : critical)
    if (t > left && t < right) places.push_back(t);
  std::sort(places.begin(), places.end());
  places.push_back(right);
  return places;
}

/// The largest amount by which the cubic F, at a place between two others of `places`, is above or below both
/// of the values that F has at these two places.
double wrong_way(const Cubic<double>& F, const std::vector<double>& places) {
  double most = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t k = i + 1; k < places.size(); ++k) {
      const double lower = std::min(F(places[i]), F(places[k]));
      const double upper = std::max(F(places[i]), F(places[k]));
      for (std::size_t j = i; j <= k; ++j)
        most = std::max({most, F(places[j]) - upper, lower - F(places[j])});
    }
  }
  return most;
}

/// The largest wrong_way() between two nodes, divided by its bound m.
double nodes_ratio(const Coefficients& k, int bits) {
  const double u = roundoff(bits);
  const Cubic<double> F = cubic<double>(k);
  const auto nodes = nodes_of(k);
  double seen = 0;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
    seen = std::max(seen, wrong_way(F, places_between(k, nodes[i], nodes[i + 1])));
  return seen / (cubic_nodes(u, 6.0, 18.0, 18.0));
}

Coefficients drawn(Random& random) {
  Coefficients k{};
  for (std::size_t i = 0; i < 4; ++i) k[i] = snapped(draw_number(random, sizes[i]));
  if (random.one_in(2)) return k;
  // Makes two critical points. Half of the time, they are near each other.
  const double t = random.uniform();
  const double other =
      random.one_in(2) ? t + random.uniform(-1, 1) * random.log_uniform(1e-6, 1) : random.uniform();
  k[1] = snapped(std::clamp(-1.5 * k[0] * (t + other), -18.0, 18.0));
  k[2] = snapped(std::clamp(3 * k[0] * t * other, -18.0, 18.0));
  return k;
}

Coefficients changed(Random& random, Coefficients k, int bits) {
  const auto i = static_cast<std::size_t>(random.integer(0, 3));
  k[i] = std::clamp(snapped(changed_number(random, k[i], sizes[i], bits)), -sizes[i], sizes[i]);
  return k;
}

template <class Value>
double highest_of(int bits, const ClimbEffort& climb, const char* name, const Value& value) {
  const MpfrFloat::PrecisionScope precision(bits);
  const double found =
      highest(
          climb, drawn, [&](Random& random, const Coefficients& k) { return changed(random, k, bits); },
          [&](const Coefficients& k) { return value(k, bits); })
          .value;
  ::testing::Test::RecordProperty(std::string(name) + " of " + std::to_string(bits) + " bits",
                                  std::to_string(found));
  return found;
}

constexpr std::array tried{8, 11, 16, 24};

TEST(ProofsSolverCubic, NodesPartFWhereASearchComesNearTheBound) {
  for (const int bits : tried) {
    const double found = highest_of(bits, {.rounds = 6, .steps = 4000}, "m", nodes_ratio);
    EXPECT_LE(found, 1) << bits;
    EXPECT_GT(found, 0) << bits;
  }
}

TEST(ProofsSolverCubic, NodesPartFForAllNumbersOfFourBits) {
  // For u = 2^-4, the full formula of the bound has no meaning, because u is too large. But the error is
  // within the bound that has only the formula's leading terms.
  constexpr int bits = 4;
  const MpfrFloat::PrecisionScope precision(bits);
  std::vector<double> all{0};
  for (int exponent = -2; exponent <= 1; ++exponent)
    for (int i = 8; i < 16; ++i)
      for (const int sign : {1, -1}) all.push_back(sign * std::ldexp(i, exponent - 3));
  double worst = 0;
  for (const double a : all) {
    if (a < 0) continue;  // the cubic -F gives the same result as F
    for (const double b : all) {
      for (const double c : all) {
        const Coefficients k{a, b, c, 0};
        const Cubic<double> F = cubic<double>(k);
        const auto nodes = nodes_of(k);
        for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
          const double seen = wrong_way(F, places_between(k, nodes[i], nodes[i + 1]));
          const double second = 6 * a + 2 * std::abs(b);
          const double u = roundoff(bits);
          worst = std::max(worst, seen / (3 * u * std::abs(c) + second * 49 * u * u));
        }
      }
    }
  }
  RecordProperty("m", std::to_string(worst));
  EXPECT_LE(worst, 1);
  EXPECT_GT(worst, 0.01);
}

/// The bound h of Horner's rule for coefficients within `sizes`.
double horner(double u) {
  return 6 * growth(u, 6) + 18 * growth(u, 5) + 18 * growth(u, 3) + 6 * growth(u, 1);
}

/// Let F̂ be the computed F. Between two nodes, |F| may be smaller than |F̂| is at both nodes. Returns the
/// largest amount by which |F| is smaller, divided by the bound h + m of this amount. If the amount reached
/// |F̂|, a root could be missed.
double nearer_ratio(const Coefficients& k, int bits) {
  const double u = roundoff(bits);
  const Cubic<double> F = cubic<double>(k);
  const Cubic<MpfrFloat> computed = cubic<MpfrFloat>(k);
  const auto nodes = nodes_of(k);
  double seen = 0;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    const auto left = static_cast<double>(computed(MpfrFloat(nodes[i])));
    const auto right = static_cast<double>(computed(MpfrFloat(nodes[i + 1])));
    const double sign = left < 0 ? -1 : 1;
    for (const double t : places_between(k, nodes[i], nodes[i + 1]))
      seen = std::max(seen, std::min(sign * left, sign * right) - sign * F(t));
  }
  return seen / (horner(u) + cubic_nodes(u, 6.0, 18.0, 18.0));
}

TEST(ProofsSolverCubic, FComesNoNearerToZeroBetweenNodesThanTheBound) {
  for (const int bits : tried) {
    const double found = highest_of(bits, {.rounds = 6, .steps = 4000}, "nearer", nearer_ratio);
    EXPECT_LE(found, 1) << bits;
    EXPECT_GT(found, 0.1) << bits;
  }
}

/// The largest |F̂| at a returned time, divided by μ, the solver's limit for |F̂|. Here, μ is as small as
/// step (3) of the proof of solve_cubic allows if F̂ changes its sign between neighbouring numbers.
double residual_ratio(const Coefficients& k, int bits) {
  const double u = roundoff(bits);
  const double mu = snapped((72 * u + horner(u)) * (1 + 16 * u));
  const Cubic<MpfrFloat> computed = cubic<MpfrFloat>(k);
  double seen = 0;
  for (const MpfrFloat& t : solve_cubic(computed, MpfrFloat(mu)))
    seen = std::max(seen, std::abs(static_cast<double>(computed(t))));
  return seen / mu;
}

TEST(ProofsSolverCubic, EveryTimeThatIsReturnedHasAResidualOfAtMostMu) {
  for (const int bits : tried) {
    const double found = highest_of(bits, {.rounds = 6, .steps = 4000}, "residual", residual_ratio);
    EXPECT_LE(found, 1) << bits;
    EXPECT_GT(found, 0.9) << bits;
  }
}

}  // namespace
}  // namespace nearmiss::proofs
