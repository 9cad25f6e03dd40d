#include "tests/proofs/ccd_problems.hpp"

#include <array>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "ccd/wang/cubic.hpp"
#include "ccd/wang/proximity.hpp"
#include "ccd/wang/ve_culling.hpp"
#include "ccd/wang/vertex_edge.hpp"
#include "ccd/wang/vertex_vertex.hpp"

namespace nearmiss::proofs {

namespace {

/// The coordinates of four vertices at t = 0 and t = 1.
struct TracedPoints {
  std::array<Traced, 24> x;
};

/// Sample coordinates of a vertex that falls through a triangle, and of an edge that falls through an edge.
/// F, the coplanarity cubic, has a simple root far from both ends of the step, so that `excludes_collision`
/// runs to its end.
constexpr std::array<double, 24> falling_vertex{0.25, 0.25, 1,  0, 0, 0, 1, 0, 0, 0, 1, 0,
                                                0.25, 0.25, -1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
constexpr std::array<double, 24> falling_edge{-1, 0, 1,  1, 0, 1,  0, -1, 0, 0, 1, 0,
                                              -1, 0, -1, 1, 0, -1, 0, -1, 0, 0, 1, 0};

TracedPoints points(Trace& trace, Kind kind) {
  TracedPoints all;
  const auto& samples = kind == vt ? falling_vertex : falling_edge;
  for (std::size_t i = 0; i < 24; ++i) {
    const std::string name{'x', static_cast<char>('0' + i / 3 % 4), i < 12 ? 's' : 'e',
                           static_cast<char>('x' + i % 3)};
    all.x[i] = trace.input(name, samples[i]);
  }
  return all;
}

/// A problem that has no inputs yet except a time.
Problem begun() {
  Problem problem;
  problem.trace = std::make_shared<Trace>();
  problem.time = problem.trace->input("t", 0.5);
  problem.inputs.push_back({problem.time, 0, 1, 0});
  return problem;
}

Traced threshold(Problem& problem, const char* name) {
  Traced input = problem.trace->input(name, 1);
  problem.inputs.push_back({input, 0, 1, 1});
  return input;
}

/// Uses the two sides of a comparison left <= right as the two sides of the problem.
void choose(Problem& problem, const Branch& comparison) {
  problem.left = Traced(comparison.left);
  problem.right = Traced(comparison.right);
}

/// A moving vector whose components are inputs.
Moving<Traced> exact_vector(Trace& trace, char name) {
  Moving<Traced> vector;
  for (int i = 0; i < 6; ++i)
    vector.xv[i] = trace.input({name, i < 3 ? 'x' : 'v', static_cast<char>('x' + i % 3)}, 0.5);
  return vector;
}

/// A pair whose coordinates are inputs.
template <Kind kind>
Pair<kind, Traced> pair_of(Problem& problem, Reach reach) {
  Pair<kind, Traced> pair;
  form_vectors(points(*problem.trace, kind), pair);
  problem.motions = {{pair.p, 1, reach == Reach::far ? 2.0 : 1.0}, {pair.q}, {pair.r}};
  return pair;
}

template <Kind kind>
Problem configuration(Reach reach, ConfigurationPart part) {
  Problem problem = begun();
  const auto pair = pair_of<kind>(problem, reach);
  const Configuration configuration(pair, problem.time);
  if (part == ConfigurationPart::normal || part == ConfigurationPart::weight) {
    problem.left = part == ConfigurationPart::normal ? configuration.N[0] : configuration.weights[0];
    problem.degree = part == ConfigurationPart::normal ? 2 : 4;
    return problem;
  }
  Tolerances<Traced> tol{};
  if (part == ConfigurationPart::height) {
    tol.eta = threshold(problem, "eta");
    std::ignore = configuration.well_shaped(tol);
    // The third edge of a triangle, r - q, is within the bound B, as q and r are.
    if (kind == vt)
      for (int i = 0; i < 3; ++i)
        problem.facts.push_back({configuration.r[i] - configuration.q[i], -1, 1, 1});
    problem.degree = 2;
  } else {
    std::ignore = configuration.inside();
    problem.degree = 4;
  }
  // The last comparison is that of the height test or, for `inside`, that of the third weight. For a
  // triangle, the third weight is computed from the other two.
  choose(problem, problem.trace->branches().back());
  return problem;
}

/// A determinant of order 3 with elements in [-1, 1] is at most 4. It is linear in each element, so it is
/// largest if all elements are 1 or -1. Then it is a multiple of 4, and at most 3√3 by Hadamard's inequality.
constexpr double determinant = 4;

void know_coefficients(Problem& problem, const Cubic<Traced>& F, double p) {
  const auto know = [&](const Traced& of, double most) { problem.facts.push_back({of, -most, most, 3}); };
  know(F.a, determinant);
  know(F.b, 3 * determinant);  // three determinants
  know(F.c, 3 * determinant);
  know(F.d, determinant);
  know(F(problem.time), p * determinant);
}

void choose(Problem& problem, const Cubic<Traced>& F, CubicPart part) {
  const std::array all{F.a, F.b, F.c, F.d, F(problem.time)};
  problem.left = all.at(static_cast<std::size_t>(part));
  problem.degree = 3;
}

template <Kind kind>
Problem cubic(CubicPart part) {
  Problem problem = begun();
  const auto F = coplanarity(pair_of<kind>(problem, kind == ee ? Reach::far : Reach::near));
  know_coefficients(problem, F, kind == ee ? 2 : 1);
  choose(problem, F, part);
  return problem;
}

/// The coefficients of the cubic as inputs, in units of B³. Their bounds also hold for computed coefficients:
/// each bound exceeds that of the exact coefficient by 1/2, which is far more than the rounding error.
Cubic<Traced> exact_coefficients(Problem& problem) {
  Cubic<Traced> F;
  for (const auto& [coefficient, name, most] :
       {std::tuple{&F.a, "a", 4.5}, {&F.b, "b", 12.5}, {&F.c, "c", 12.5}, {&F.d, "d", 4.5}}) {
    *coefficient = problem.trace->input(name, 1);
    problem.inputs.push_back({*coefficient, -most, most, 1});
  }
  problem.degree = 1;
  return F;
}

/// The vectors of a pair whose end points may have any order. If an end point of one edge is within B* of an
/// end point of the other edge, any two end points are within 3B* at t = 0 and within 4B* at t = 1
/// (motion.hpp). Here, B* = E + W = 1.
template <Kind kind>
Pair<kind, Traced> pair_with_bound(Problem& problem) {
  auto pair = pair_of<kind>(problem, Reach::near);
  if (kind == ee) {
    problem.motions[0].start = 3;
    problem.motions[0].end = 4;
  }
  detail::form_bound(pair);
  problem.facts = {{pair.E, 0, 1, 1}, {pair.W, 0, 1, 1}, {pair.E + pair.W, 1, 1, 1}};
  problem.degree = 1;
  return pair;
}

/// The problem of the last comparison in `excludes_collision` (w > N·N + slack, for a weight w), and the
/// slack. The slack is computed from h, the half width of the interval around the root, which is an input in
/// [0, 1].
struct Culling {
  Problem problem;
  Traced slack;
};

template <Kind kind>
Culling culling() {
  Problem problem = begun();
  auto pair = pair_with_bound<kind>(problem);
  problem.motions[0] = {pair.p, 1, kind == ee ? 2.0 : 1.0};
  problem.facts = {{pair.W, 0, 1, 1}};
  problem.degree = 4;
  pair.B = problem.trace->input("B", 4);
  problem.inputs.push_back({pair.B, 1, 1, 1});
  const Configuration configuration(pair, problem.time);
  Tolerances<Traced> tol{};
  if (excludes_collision<VeCulling::per_root>(pair, coplanarity(pair), configuration, problem.time, tol))
    throw std::runtime_error("the sample is a collision, but it is excluded");
  // The last comparisons that the trace has recorded are h > 1, and then w < -slack and N·N + slack < w for
  // each weight w.
  const auto& branches = problem.trace->branches();
  const auto last = branches.size() - 1;
  const Branch& h_above_1 = branches.at(last - 2 * configuration.weights.size());
  if (h_above_1.left->operation != Operation::constant || h_above_1.left->value != 1)
    throw std::runtime_error("the last comparison before those of weights is not with 1");
  problem.inputs.push_back({Traced(h_above_1.right), 0, 1, 0});
  problem.left = Traced(branches[last].right);
  problem.right = Traced(branches[last].left);
  return {problem, Traced(branches[last].left->right)};
}

Problem spread_of(Culling culling) {
  culling.problem.left = Traced(culling.slack.node()->left);
  culling.problem.right = 0;
  return culling.problem;
}

Problem near_edge(Reach reach, bool F) {
  Problem problem = begun();
  const TracedPoints x = points(*problem.trace, vt);
  const VertexEdge<Traced> ve{relative_motion<Traced>(x, 0, 1), relative_motion<Traced>(x, 2, 1), {}};
  const double most = reach == Reach::far ? 2 : 1;
  problem.motions = {{ve.x0i, most, most}, {ve.xji}};
  problem.degree = 2;
  Tolerances<Traced> tol{};
  if (F) tol.S = threshold(problem, "S");
  // The sample is above the edge, so that near_edge makes all of its comparisons.
  detail::near_edge(ve, problem.time, tol);
  choose(problem, problem.trace->branches().at(F ? 3 : 2));
  return problem;
}

/// The squared distance of two vertices. The time is an input of the problem; it is not computed.
Problem squared_distance(Problem problem, const Moving<Traced>& ji) {
  Tolerances<Traced> any_distance{};
  any_distance.D2 = std::numeric_limits<double>::infinity();
  problem.time = *vertex_vertex(ji, any_distance);
  problem.inputs = {{problem.time, 0, 1, 0}};
  problem.left = Traced(problem.trace->branches().back().left);
  problem.degree = 2;
  return problem;
}

}  // namespace

Problem configuration(Kind kind, Reach reach, ConfigurationPart part) {
  return kind == vt ? configuration<vt>(reach, part) : configuration<ee>(reach, part);
}

Problem cubic(Kind kind, CubicPart part) { return kind == vt ? cubic<vt>(part) : cubic<ee>(part); }

Problem exact_cubic(CubicPart part) {
  Problem problem = begun();
  Pair<vt, Traced> pair;
  pair.p = exact_vector(*problem.trace, 'p');
  pair.q = exact_vector(*problem.trace, 'q');
  pair.r = exact_vector(*problem.trace, 'r');
  problem.motions = {{pair.p}, {pair.q}, {pair.r}};
  const auto F = coplanarity(pair);
  know_coefficients(problem, F, 1);
  choose(problem, F, part);
  return problem;
}

Problem horner() {
  Problem problem = begun();
  problem.left = exact_coefficients(problem)(problem.time);
  return problem;
}

Problem clearance_of_exact() {
  Problem problem = begun();
  problem.left = clearance(exact_coefficients(problem));
  return problem;
}

Problem bound(Kind kind) {
  Problem problem = begun();
  problem.left = kind == vt ? pair_with_bound<vt>(problem).B : pair_with_bound<ee>(problem).B;
  return problem;
}

Problem extents(Kind kind) {
  Problem problem = bound(kind);
  problem.left = Traced(problem.left.node()->left);
  return problem;
}

Problem spread(Kind kind) { return spread_of(kind == vt ? culling<vt>() : culling<ee>()); }

Problem culling(Kind kind) { return (kind == vt ? culling<vt>() : culling<ee>()).problem; }

Problem vertex_edge(Reach reach, EdgePart part) {
  const bool F = part == EdgePart::F || part == EdgePart::F_without_S || part == EdgePart::F_of_S;
  Problem problem = near_edge(reach, F);
  const Node& difference = *problem.left.node();
  switch (part) {
    case EdgePart::length2:
      problem.left = problem.right;
      [[fallthrough]];
    case EdgePart::weight:
      [[fallthrough]];
    case EdgePart::F:
      problem.right = 0;
      break;
    case EdgePart::inside:
      break;
    // F = (‖x_0i × x_ji‖₁ - S ‖x_ji‖∞)(1 + δ). Each part ends with a rounding; the addition of 0 stands for
    // this rounding.
    case EdgePart::F_without_S:
      problem.left = Traced(difference.left) + 0;
      problem.right = 0;
      break;
    case EdgePart::F_of_S:
      problem.left = Traced(difference.right) + 0;
      problem.right = 0;
      break;
  }
  return problem;
}

Problem exact_vertices(Reach reach, VertexPart part) {
  Problem problem = begun();
  const auto ji = exact_vector(*problem.trace, 'x');
  // `ji` stands for a vector that is computed from exact ones. Rounding makes it longer by at most a factor
  // of 1 + 5u, and 5u <= 2^-8.
  constexpr double longer = 1 + 0x1p-8;
  const double most = (reach == Reach::far ? 2 : 1) * longer;
  problem.motions = {{ji, most, most, longer}};
  problem = squared_distance(problem, ji);
  if (part == VertexPart::squared_distance) return problem;
  // t = min(max(-x·v / v·v, 0), 1)
  const Traced quotient(problem.time.node()->left->left);
  const Traced vv(quotient.node()->right);
  problem.inputs.clear();
  problem.motions = {{ji, most / longer, most / longer}};
  if (part == VertexPart::xv) problem.left = Traced(quotient.node()->left);
  if (part == VertexPart::vv) problem.left = vv;
  if (part == VertexPart::time) {
    problem.left = quotient;
    // Since a component of v is 1, the quotient is at most ‖x‖/‖v‖ <= √3 ‖x‖∞.
    const double steepest = 1.7320508076 * most / longer;
    problem.facts = {{vv, 1, 3, 2}, {quotient, -steepest, steepest, 0}};
    problem.degree = 0;
  }
  return problem;
}

Problem vertices(Reach reach) {
  Problem problem = begun();
  const auto ji = relative_motion<Traced>(points(*problem.trace, vt), 0, 1);
  const double most = reach == Reach::far ? 2 : 1;
  problem.motions = {{ji, most, most}};
  return squared_distance(problem, ji);
}

}  // namespace nearmiss::proofs
