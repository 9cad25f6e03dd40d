// The distance at a time is at most a number b if and only if one of finitely many statements holds. Each
// statement is about a pair of features: a vertex of each primitive, a vertex and an edge, the vertex and the
// triangle, or two edges. A statement says that the closest points of the lines or planes through the two
// features lie in the features and are within b of each other. The statement holds at t iff the polynomials
// `excess` and `outside` are at most 0 at t, and `extents` are positive. (If the features are degenerate, an
// extent is 0, and the statement does not hold. Then statements about other features, such as the ends of an
// edge of length 0, cover the same points.) If the distance is at most b, the statement about the closest
// pair of features holds. If any statement holds, two points of the primitives are within b of each other.
//
// The sign of (distance - b) is 1, 0 or -1, and changes only at a time at which the distance is b. First
// case: at t0, the sign changes to or from -1. On the side of t0 with the sign -1, the statement about a
// closest pair holds strictly. At t0, by continuity, the pair's `outside` are at most 0, and its excess is at
// most 0. The excess is not negative at t0: if the extents are positive, a negative excess would mean a
// distance of less than b, and if an extent is 0, the excess is 0, too. So t0 is a root of the excess, which
// is not identically 0. Second case: at t0, the sign changes between 0 and 1. On the side with the sign 0, a
// closest pair is b apart for some time, so its excess is identically 0. On the side with the sign 1, the
// pair's statement does not hold. Its extents have only isolated zeros, so one of its `outside` must be
// positive on this side, and 0 at t0. In both cases, all of the pair's `outside` are at most 0 at t0.
#include "oracle/exact/nearness.hpp"

#include <algorithm>
#include <utility>

namespace nearmiss::exact {

using Features = FeatureNearness::Features;

bool FeatureNearness::is_inside_at(Root& t) const {
  return std::all_of(outside.begin(), outside.end(), [&](const Polynomial& p) { return t.sign_of(p) <= 0; });
}

bool FeatureNearness::is_extended_at(Root& t) const {
  return std::all_of(extents.begin(), extents.end(), [&](const Polynomial& p) { return t.sign_of(p) > 0; });
}

namespace {

Interiors vertex_and_triangle(const std::array<PolynomialVector, 4>& x) {
  const PolynomialVector N = cross(x[2] - x[1], x[3] - x[1]);
  std::vector<Polynomial> outside;
  for (std::size_t i = 1; i < 4; ++i) outside.push_back(dot(N, cross(x[0] - x[i], x[i % 3 + 1] - x[i])));
  return {dot(x[0] - x[1], N), dot(N, N), std::move(outside)};
}

Interiors two_edges(const std::array<PolynomialVector, 4>& x) {
  const PolynomialVector u = x[1] - x[0];
  const PolynomialVector v = x[3] - x[2];
  const PolynomialVector x20 = x[2] - x[0];
  const PolynomialVector N = cross(u, v);
  const Polynomial whole = dot(N, N);  // the weights α and β are `alpha` and `beta` below divided by this
  const Polynomial alpha = dot(cross(x20, v), N);
  const Polynomial beta = dot(cross(x20, u), N);
  return {dot(x20, N), whole, {Polynomial() - alpha, alpha - whole, Polynomial() - beta, beta - whole}};
}

}  // namespace

Interiors interiors(Kind kind, const std::array<PolynomialVector, 4>& x) {
  return has_triangle(kind) ? vertex_and_triangle(x) : two_edges(x);
}

Nearness::Nearness(const Query& query, double b) {
  const Unit unit(query);
  const Number scaled_b = unit.scaled(b);
  squared_b_ = Polynomial({scaled_b * scaled_b});
  const auto x = moving_points(query, unit);
  const Topology& of = topology(query.kind);
  for (const VertexPair gap : of.gaps) add_vertices(x[gap.from], x[gap.to]);
  for (const auto& [vertex, from, to] : of.vertices_and_edges) add_vertex_and_edge(x[vertex], x[from], x[to]);
  add_interiors(interiors(query.kind, x));
}

bool Nearness::holds_at(Root& t) const {
  return std::any_of(statements_.begin(), statements_.end(),
                     [&](const FeatureNearness& each) { return each.holds_at(t); });
}

bool Nearness::holds_strictly_at(Root& t) const {
  return std::any_of(statements_.begin(), statements_.end(),
                     [&](const FeatureNearness& each) { return each.holds_strictly_at(t); });
}

std::vector<Root> Nearness::candidates() const {
  std::vector<Root> times{Root(Number(0))};
  for (const FeatureNearness& each : statements_) {
    const auto add_roots = [&](const Polynomial& p) {
      for (Root& t : roots_in_step(p))
        if (each.is_inside_at(t)) times.push_back(std::move(t));
    };
    if (!each.excess.is_zero()) {
      add_roots(each.excess);
      continue;
    }
    for (const Polynomial& p : each.outside)
      if (!p.is_zero()) add_roots(p);
  }
  return times;
}

void Nearness::add_vertices(const PolynomialVector& x, const PolynomialVector& y) {
  const PolynomialVector d = x - y;
  statements_.push_back({Features::vertices, dot(d, d) - squared_b_, {}, {}});
}

void Nearness::add_vertex_and_edge(const PolynomialVector& x, const PolynomialVector& from,
                                   const PolynomialVector& to) {
  const PolynomialVector d = x - from;
  const PolynomialVector e = to - from;
  const PolynomialVector area = cross(d, e);
  const Polynomial along = dot(d, e);
  const Polynomial length = dot(e, e);
  statements_.push_back({Features::vertex_and_edge,
                         dot(area, area) - squared_b_ * length,
                         {Polynomial() - along, along - length},
                         {length}});
}

void Nearness::add_interiors(Interiors&& of) {
  auto& [F, squared_N, outside] = of;
  statements_.push_back(
      {Features::interiors, F * F - squared_b_ * squared_N, std::move(outside), {squared_N}});
}

// For each pair of features, the constructor collects times at which the closest points of the lines or
// planes lie in the features. The smallest distance over the step is the distance of some pair at one of the
// times collected for this pair. Proof: Let the smallest distance be reached at t0. Among the pairs of
// features that are at this distance at t0, take one of the lowest dimension. If t0 is neither 0 nor 1, the
// closest points of the lines or planes through these two features are strictly inside the features, which
// are not degenerate: otherwise the closest points would lie in features of a lower dimension. So around t0,
// the distance of the features is that of the lines or planes. The square of this distance is a quotient of
// polynomials with a minimum at t0, so its derivative is 0 at t0. If the derivative is not identically 0, t0
// is one of its roots. Otherwise the distance stays the same until t is 0 or 1, or until the closest points
// leave the inside of the features; at that time, features of a lower dimension are at the same distance.
SmallestDistance::SmallestDistance(const Query& query) : unit_(query) {
  const Interiors of = interiors(query.kind, moving_points(query, unit_));
  // For b = 0, the excess of each statement is the numerator of a squared distance.
  const Nearness contact(query, 0);
  for (const FeatureNearness& each : contact.statements()) {
    const bool are_vertices = each.extents.empty();
    Minima minima{each.excess, are_vertices ? Polynomial({Number(1)}) : each.extents[0], {}};
    const auto& [numerator, denominator, unused] = minima;
    const auto add_time = [&](Root t) {
      if (each.is_inside_at(t) && each.is_extended_at(t)) minima.times.push_back(std::move(t));
    };
    const auto add_roots = [&](const Polynomial& p) {
      if (p.is_zero()) return;
      for (Root& t : roots_in_step(p)) add_time(std::move(t));
    };
    for (const int end : {0, 1}) add_time(Root(Number(end)));
    if (each.features == Features::interiors) {
      // The squared distance is F² / N². The numerator of its derivative has the factor F.
      const Polynomial twice({Number(2)});
      add_roots(of.F);
      add_roots(twice * of.F.derivative() * denominator - of.F * denominator.derivative());
    } else {
      add_roots(numerator.derivative() * denominator - numerator * denominator.derivative());
    }
    if (!minima.times.empty()) minima_.push_back(std::move(minima));
  }
}

bool SmallestDistance::is_at_most(double bound) {
  const Number scaled = unit_.scaled(bound);
  const Polynomial squared({scaled * scaled});
  return std::any_of(minima_.begin(), minima_.end(), [&](Minima& each) {
    const Polynomial excess = each.numerator - squared * each.denominator;
    return std::any_of(each.times.begin(), each.times.end(), [&](Root& t) { return t.sign_of(excess) <= 0; });
  });
}

}  // namespace nearmiss::exact

namespace nearmiss {

bool comes_within(const Query& query, double bound) {
  return exact::SmallestDistance(query).is_at_most(bound);
}

}  // namespace nearmiss
