// Tests the claim of vertex_edge about ψ, the limit for F_0ij at a candidate time: on the way from any time
// to a candidate time, F_0ij rises by at most the bound on which ψ is based.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "ccd/wang/bounds/tight_tolerances.hpp"
#include "ccd/wang/vertex_edge.hpp"
#include "tests/proofs/climb.hpp"
#include "tests/proofs/solver_orders.hpp"

namespace nearmiss::proofs {
namespace {

/// The inputs x_0i (position within 2, velocity within 1), x_ji (within 1) and S. They are numbers in the
/// thread's precision, taken as exact.
struct EdgeProblem {
  std::array<double, 12> xv;
  double S;

  static double size(std::size_t i) { return i < 3 ? 2 : 1; }

  template <class T>
  [[nodiscard]] Moving<T> moving(std::size_t first) const {
    Moving<T> m;
    for (int i = 0; i < 6; ++i) m.xv[i] = T(xv[first + static_cast<std::size_t>(i)]);
    return m;
  }
};

EdgeProblem snapped(EdgeProblem p) {
  for (std::size_t i = 0; i < 12; ++i)
    p.xv[i] = std::clamp(proofs::snapped(p.xv[i]), -EdgeProblem::size(i), EdgeProblem::size(i));
  p.S = proofs::snapped(p.S);
  return p;
}

EdgeProblem drawn(Random& random) {
  EdgeProblem p{};
  for (std::size_t i = 0; i < 12; ++i) p.xv[i] = draw_number(random, EdgeProblem::size(i));
  p.S = random.one_in(2) ? random.log_uniform(1e-4, 2) : 0;
  return snapped(p);
}

EdgeProblem changed(Random& random, EdgeProblem p, int bits) {
  for (int count = random.integer(1, 3); count > 0; --count) {
    const auto i = static_cast<std::size_t>(random.integer(0, 12));
    if (i == 12)
      p.S = std::abs(changed_number(random, p.S, 1, bits));
    else
      p.xv[i] = changed_number(random, p.xv[i], EdgeProblem::size(i), bits);
  }
  return snapped(p);
}

struct Checkpoint {
  double t;
  bool candidate;
  double F;
};

/// In ascending order: the times 0 and 1, all computed candidates of cases 2 and 4, and all times at which
/// the exact F turns. Between two neighbours, F is monotonic. (Values in double stand for exact ones, because
/// the tested numbers have far fewer bits.)
std::vector<Checkpoint> checkpoints_of(const EdgeProblem& p, double rho) {
  std::vector<Checkpoint> checkpoints;
  const auto add = [&](double t, bool candidate) { checkpoints.push_back({t, candidate, 0}); };
  add(0, true);
  add(1, true);
  const auto coarse_edge = p.moving<MpfrFloat>(6);
  const detail::CrossProduct<MpfrFloat> coarse(p.moving<MpfrFloat>(0), coarse_edge, MpfrFloat(rho));
  for (const MpfrFloat& t : detail::zero_components(coarse)) add(static_cast<double>(t), true);
  for (const MpfrFloat& t : detail::piece_minima(coarse, coarse_edge, MpfrFloat(p.S)))
    add(static_cast<double>(t), true);

  const auto vertex = p.moving<double>(0);
  const auto edge = p.moving<double>(6);
  const detail::CrossProduct<double> exact(vertex, edge, 0);
  for (const double t : detail::zero_components(exact)) add(t, false);
  for (const double t : detail::piece_minima(exact, edge, p.S)) add(t, false);
  for (const double t : detail::equal_components(edge)) add(t, false);
  for (Checkpoint& each : checkpoints) {
    const Vector3<double> e = edge.at(each.t);
    each.F = vertex.at(each.t).cross(e).lpNorm<1>() - p.S * max_component(e);
  }
  std::sort(checkpoints.begin(), checkpoints.end(),
            [](const Checkpoint& a, const Checkpoint& b) { return a.t < b.t; });
  return checkpoints;
}

/// The largest rise of F on the way from a checkpoint to the nearest candidate on one side.
template <class Iterator>
double rise_to_candidate(Iterator from, Iterator end) {
  double top = from->F;
  for (Iterator each = from; each != end; ++each) {
    top = std::max(top, each->F);
    if (each->candidate) return top - from->F;
  }
  return std::numeric_limits<double>::infinity();
}

/// For each checkpoint, takes the side on which F rises less on the way to the nearest candidate. Returns the
/// largest of these rises, divided by the bound. Coefficients below ρ are dropped.
double rise_ratio(const EdgeProblem& p, int bits, double rho) {
  const auto checkpoints = checkpoints_of(p, rho);
  double rise = 0;
  for (auto each = checkpoints.begin(); each != checkpoints.end(); ++each)
    rise =
        std::max(rise, std::min(rise_to_candidate(each, checkpoints.end()),
                                rise_to_candidate(std::make_reverse_iterator(each + 1), checkpoints.rend())));
  const double u = roundoff(bits);
  const auto bounds = edge_bounds(u, 2, 3, 2);  // for exact vectors
  return rise / (edge_difference(u, bounds) + edge_rise(u, bounds, p.S) + 12 * rho);
}

double highest_rise(int bits, double rho, const ClimbEffort& climb) {
  const MpfrFloat::PrecisionScope precision(bits);
  const double found =
      highest(
          climb, drawn, [&](Random& random, const EdgeProblem& p) { return changed(random, p, bits); },
          [&](const EdgeProblem& p) { return rise_ratio(p, bits, rho); })
          .value;
  ::testing::Test::RecordProperty("of " + std::to_string(bits) + " bits", std::to_string(found));
  return found;
}

// The rise is a multiple of u, not of u^½. If the rise contained the square root of a rounding error, the
// ratio would grow with the number of bits like u^-½: by 2^12 from 8 to 32 bits. (Up to 17 bits, u^½ is below
// the bound, 470 u, so only the runs with more bits can show such a growth.)
TEST(ProofsSolverEdge, FRisesByRoundingsAlone) {
  for (const int bits : {8, 11, 16, 24, 32}) {
    const double found = highest_rise(bits, 2 * roundoff(bits), {.rounds = 5, .steps = 2500});
    EXPECT_LE(found, 1) << bits;
    EXPECT_GT(found, 0.01) << bits;
  }
}

// With the paper's ρ, 3 ε^½, the coefficients that are dropped are far larger than all roundings.
TEST(ProofsSolverEdge, FRisesByWhatIsDropped) {
  for (const int bits : {16, 24, 32}) {
    const double found = highest_rise(bits, 3 * std::sqrt(2 * roundoff(bits)), {.rounds = 5, .steps = 2500});
    EXPECT_LE(found, 1) << bits;
    EXPECT_GT(found, 0.05) << bits;
  }
}

// constraints.hpp: ‖d × e‖₁ <= √8 ‖d‖ ‖e‖∞ for d at right angles to e. For a vector s of signs, the square of
// s · (d × e) is at most d·d (3 e·e - (s·e)²). This bound is convex in e, so checking the corners of the cube
// is enough.
TEST(ProofsSolverEdge, RootEightIsEnoughForS) {
  const auto corner = [](int i) {
    return Vector3<double>((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
  };
  for (int e = 0; e < 8; ++e) {
    for (int s = 0; s < 8; ++s) {
      const double along = corner(s).dot(corner(e));
      EXPECT_LE(3 * corner(e).squaredNorm() - along * along, 8);
    }
  }
  double largest = 0;
  Random random(3, 0, 0);
  for (int i = 0; i < 100000; ++i) {
    const Vector3<double> e = random.one_in(2) ? random.vector(1) : corner(i % 8) + random.vector(0.1);
    const Vector3<double> d = e.cross(random.vector(1));
    largest = std::max(largest, d.cross(e).lpNorm<1>() / (d.norm() * max_component(e)));
  }
  EXPECT_LE(largest, std::sqrt(8) * (1 + 1e-14));
  EXPECT_GT(largest, 2.8);
}

/// A vertex within R of an edge at some time, with numbers in the thread's precision. Returns nothing if
/// rounding moves the vertex farther away.
std::optional<EdgeProblem> within_R(Random& random, double R) {
  EdgeProblem p = drawn(random);
  const auto edge = p.moving<double>(6);
  const double t = random.one_in(4) ? random.integer(0, 1) : random.uniform();
  const Vector3<double> e = edge.at(t);
  const Vector3<double> off = e.cross(random.vector(1));
  const Vector3<double> there = random.uniform() * e + R * 0.999 * off / off.norm();
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    p.xv[k] = there[i] - t * p.xv[k + 3];
    if (!(std::abs(p.xv[k]) <= 2)) return std::nullopt;
  }
  p = snapped(p);
  const Vector3<double> x = p.moving<double>(0).at(t);
  const double along = x.dot(e) / e.squaredNorm();
  if (!(along >= 0 && along <= 1) || !((x - along * e).norm() <= R)) return std::nullopt;
  return p;
}

TEST(ProofsSolverEdge, EveryVertexWithinRIsReported) {
  for (const int bits : {11, 16, 24, 40}) {
    const MpfrFloat::PrecisionScope precision(bits);
    const auto tol = tolerances_of(solve_tight(1 - bits), epsilon<MpfrFloat>(), MpfrFloat(1));
    const auto R = static_cast<double>(tol.S) / std::sqrt(8);
    int reported_by_edge = 0;
    for (std::uint64_t i = 0; i < 20000; ++i) {
      Random random(9, static_cast<std::uint64_t>(bits), i);
      const auto p = within_R(random, R);
      if (!p) continue;
      const auto vertex = p->moving<MpfrFloat>(0);
      const auto edge = p->moving<MpfrFloat>(6);
      const VertexEdge<MpfrFloat> ve{vertex, edge, {vertex.xv - edge.xv}};
      const Verdict verdict = vertex_edge(ve, tol);
      ASSERT_TRUE(verdict.hit) << bits << " bits, " << i;
      if (verdict.stage != Stage::vv) ++reported_by_edge;
    }
    EXPECT_GT(reported_by_edge, 1000) << bits;
  }
}

}  // namespace
}  // namespace nearmiss::proofs
