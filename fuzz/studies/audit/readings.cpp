#include "fuzz/studies/audit/readings.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "ccd/cubic.hpp"
#include "ccd/proximity.hpp"
#include "ccd/ve_culling.hpp"
#include "ccd/vertex_edge.hpp"
#include "fuzz/studies/audit/audit.hpp"

namespace nearmiss::audit_parts {

namespace {

constexpr double eps = epsilon<double>();
constexpr Kind vt = Kind::vertex_triangle;
constexpr Kind ee = Kind::edge_edge;

double magnitude(const Rational& x) { return std::abs(static_cast<double>(x)); }

/// The error of a value, for operations with a relative error of ω ε.
Reading reading(const AuditedRational& f, const AuditSample& s, double omega = 1) {
  const ErrorBound& bound = f.bound();
  return {omega * bound.error(), magnitude(f.error()) / (std::pow(s.B, bound.degree) * eps), bound};
}

/// Both sides of a comparison.
using ComparedSides = std::pair<AuditedRational, AuditedRational>;
Reading reading(const ComparedSides& c, const AuditSample& s, double omega = 1) {
  const ErrorBound a = c.first.bound();
  const ErrorBound b = c.second.bound();
  const int degree = a.coefficient > 0 ? a.degree : b.degree;
  return {omega * (a.error() + b.error()),
          magnitude(c.first.error() - c.second.error()) / (std::pow(s.B, degree) * eps),
          {(a.k > 0 ? a.coefficient : 0) + (b.k > 0 ? b.coefficient : 0), degree, std::max(a.k, b.k)}};
}

Reading larger(const Reading& a, const Reading& b) {
  Reading sum = a.derived >= b.derived ? a : b;
  sum.seen = std::max(a.seen, b.seen);
  return sum;
}

Tolerances<AuditedRational> thresholds(const AuditSample& s) {
  Tolerances<AuditedRational> tol{};
  for (AuditedRational* area : {&tol.tau, &tol.psi, &tol.lambda2, &tol.D2, &tol.delta, &tol.rho})
    *area = threshold(0, 2);
  tol.eta = threshold(s.eta, 1);
  tol.S = threshold(s.S, 1);
  return tol;
}

/// A cubic whose exact coefficients are the computed ones.
Cubic<AuditedRational> as_exact(const Cubic<AuditedRational>& F) {
  const auto exact = [](const AuditedRational& c) {
    return AuditedRational(c.value(), c.value(), {c.bound().coefficient, c.bound().degree, 0});
  };
  return {exact(F.a), exact(F.b), exact(F.c), exact(F.d)};
}

/// The readings of the area, the height, a weight and its comparison with N·N.
template <Kind kind>
Readings configuration(const Pair<kind, AuditedRational>& pair, const AuditSample& s, double omega) {
  const Configuration<kind, AuditedRational> configuration(pair, exact_time(s.t));
  std::vector<ComparedSides> kept;
  const ComparisonLog<Rational> log(kept);
  std::ignore = configuration.well_shaped(thresholds(s), log);
  const Reading area = reading(kept.at(0), s, omega);
  const Reading height = reading(kept.at(1), s, omega);
  kept.clear();
  std::ignore = configuration.inside(log);
  // The third weight of a triangle is the sum of the others; its comparison has the largest error.
  Reading weight = larger(reading(kept.at(0), s, omega), reading(kept.at(2), s, omega));
  Reading criterion = larger(reading(kept.at(1), s, omega), reading(kept.at(3), s, omega));
  if constexpr (kind == vt) criterion = larger(criterion, reading(kept.at(5), s, omega));
  return {area, height, weight, criterion};
}
}  // namespace

Readings coefficients(const AuditSample& s) {
  const auto F = coplanarity(exact_pair<vt>(s));
  return {larger(reading(F.a, s), reading(F.d, s)), larger(reading(F.b, s), reading(F.c, s))};
}

Readings cubic_value(const AuditSample& s) {
  return {reading(coplanarity(exact_pair<vt>(s))(exact_time(s.t)), s)};
}

template <Kind kind>
Readings exact_configuration(const AuditSample& s) {
  return configuration(exact_pair<kind>(s), s, 1);
}
Readings far_configuration(const AuditSample& s) {
  const Readings all = exact_configuration<ee>(s);
  return {all[2], all[3]};
}
template <Kind kind>
Readings rounded_configuration(const AuditSample& s) {
  Readings all = configuration(rounded_pair<kind>(*s.query), s, 0.5);
  all.push_back(all.back());  // a second time, for `weight_error`
  return all;
}

template <Kind kind>
Readings rounded_cubic(const AuditSample& s) {
  auto pair = rounded_pair<kind>(*s.query);
  const auto F = coplanarity(pair);
  detail::form_bound(pair);
  return {reading(F(exact_time(s.t)), s, 0.5), reading(clearance(as_exact(F)), s, 0.5),
          reading(pair.B, s, 0.5)};
}

Readings near_edge(const AuditSample& s) {
  const Moving<AuditedRational> a = exactly(s.p, s.reach);
  std::vector<ComparedSides> kept;
  detail::near_edge(VertexEdge<AuditedRational>{a, exactly(s.q), a}, exact_time(s.t), thresholds(s),
                    ComparisonLog<Rational>(kept));
  return {reading(kept.at(0), s), reading(kept.at(1), s), reading(kept.at(2), s), reading(kept.at(3), s)};
}

Readings quadratic_residual(const AuditSample& s) {
  const double rho = 3 * std::sqrt(eps) * s.B * s.B;
  const detail::CrossProduct<AuditedRational> g(exactly(s.p, s.reach), exactly(s.q), threshold(rho, 2));
  double kappa = 0;
  double seen = 0;
  for (int k = 0; k < 3; ++k) {
    const auto& [a, b, c] = std::tie(g.a[k], g.b[k], g.c[k]);
    kappa = std::max(kappa, a.bound().error() + b.bound().error() + c.bound().error() +
                                quadratic_error(a.bound().coefficient, c.bound().coefficient));
    if (b.exact() * b.exact() < 4 * a.exact() * c.exact()) continue;  // there is no root to miss
    CandidateTimes<double, 2> times;
    solve_quadratic(times, a.value(), b.value(), c.value());
    for (const double t : times) {
      const Rational residual = (a.exact() * t + b.exact()) * t + c.exact();
      seen = std::max(seen, magnitude(residual) / (s.B * s.B * eps));
    }
  }
  return {{kappa, seen}};
}

namespace {

/// `candidate_error` of a sample, in units of B²ε, for S in units of B.
double candidate_bound(const AuditSample& s, double S) {
  const detail::CrossProduct<AuditedRational> g(exactly(s.p, s.reach), exactly(s.q), threshold(0, 2));
  double kappa = 0;
  double a = 0;
  double b = 0;
  for (int k = 0; k < 3; ++k) {
    const ErrorBound& c = g.c[k].bound();
    kappa = std::max(kappa, g.a[k].bound().error() + g.b[k].bound().error() + c.error() + 2 * c.coefficient);
    a = std::max(a, g.a[k].bound().coefficient);
    b = std::max(b, g.b[k].bound().coefficient);
  }
  return candidate_error(kappa, a, b, S);
}

}  // namespace

Readings missed_minimum(const AuditSample& s) {
  const double root_eps = std::sqrt(eps);
  const double unit = s.B * s.B * root_eps;
  const double S = 18 * s.B * std::sqrt(std::sqrt(eps));
  const double derived = 12 * 3 + candidate_bound(s, S / s.B) * root_eps;  // ρ = 3 B²ε^½
  const double F_error = near_edge(s).back().derived * root_eps;
  const auto F = [&](double t) {
    const Vector3<double> e = s.q.at(t);
    return norm_1(s.p.at(t).cross(e)) - S * max_component(e);
  };
  double best = std::min(F(0), F(1));
  const auto look = [&](const auto& times) {
    for (const double t : times) best = std::min(best, F(t));
  };
  const detail::CrossProduct<double> g(s.p, s.q, 3 * unit);
  look(detail::equal_components(s.q));
  look(detail::zero_components(g));
  look(detail::piece_minima(g, s.q, S));
  double lowest = best;
  double at = 0;
  const auto try_time = [&](double t) {
    if (t >= 0 && t <= 1 && F(t) < lowest) lowest = F(at = t);
  };
  constexpr int places = 64;
  for (int i = 0; i <= places; ++i) try_time(static_cast<double>(i) / places);
  for (int halvings = 0; halvings < 34; ++halvings) {
    const double step = std::ldexp(1.0 / places, -halvings);
    const double middle = at;
    try_time(middle - step);
    try_time(middle + step);
  }
  const double seen = (best - lowest) / unit;
  return {{derived, seen, {}, false}, {derived + F_error, seen, {}, false}};
}

Readings vertex_vertex_time(const AuditSample& s) {
  const Moving<AuditedRational> ji = exactly(s.p, s.reach);
  const Reading m = reading(dot(ji.x(), ji.v()), s);
  const Reading n = reading(dot(ji.v(), ji.v()), s);
  std::vector<ComparedSides> kept;
  const auto t = vertex_vertex(ji, thresholds(s), ComparisonLog<Rational>(kept));
  const AuditedRational& squared = kept.at(0).first;
  const Rational there = ji.at(exact_time(t->value())).squaredNorm().exact() - squared.exact();
  const double area = s.B * s.B * eps;
  const double b = max_component(s.p.v());
  // |m̂/n̂ - m/n| <= (3Bb k_m + 3b² k_n) ε/b², and dividing adds ε: all together 2 ε/2 (B/b + 1).
  const double time = std::max(m.derived, n.derived) + 0.5;
  // 2 ‖x‖ ‖v‖ |t̂ - t| with ‖x‖ <= √3 B (reach) and ‖v‖ <= √3 b.
  const double moved = 2 * 3 * s.reach * (m.derived + n.derived + 1);
  const double evaluation = ji.at(exact_time(s.t)).squaredNorm().bound().error();
  return {m,
          n,
          {time, b > 0 ? magnitude(t->error()) / (eps * (s.B / b + 1)) : 0, {}, false},
          {moved, magnitude(there) / area, {}, false},
          {moved + evaluation, magnitude(squared.error()) / area, {}, false}};
}

Readings far_vertices(const AuditSample& s) { return {vertex_vertex_time(s).back()}; }

Readings cubic_residual(const AuditSample& s) {
  const auto F = coplanarity(exact_pair<vt>(s));
  const Cubic<AuditedRational> taken = as_exact(F);
  double coefficients = 0;
  for (const AuditedRational* c : {&F.a, &F.b, &F.c, &F.d}) coefficients += c->bound().error();
  const auto bound = [](const AuditedRational& c) { return c.bound().coefficient; };
  const double horner = horner_error(bound(taken.a), bound(taken.b), bound(taken.c), bound(taken.d));
  double seen = 0;
  const Cubic<double> computed{F.a.value(), F.b.value(), F.c.value(), F.d.value()};
  for (const double t : solve_cubic(computed, 0.0)) {
    const Rational value = ((F.a.exact() * t + F.b.exact()) * t + F.c.exact()) * t + F.d.exact();
    seen = std::max(seen, magnitude(value) / (s.B * s.B * s.B * eps));
  }
  return {{cubic_error(coefficients, horner, bound(taken.c)), seen}};
}

Readings weight_spread(const AuditSample& s) {
  const auto pair = exact_pair<ee>(s);
  const Configuration<ee, AuditedRational> configuration(pair, exact_time(s.t));
  double seen = 0;
  for (const AuditedRational& w : configuration.weights)
    seen = std::max(seen, std::abs(w.value()) / std::pow(s.B, 4));
  return {{9, seen, {}, false}};
}

template Readings exact_configuration<vt>(const AuditSample&);
template Readings exact_configuration<ee>(const AuditSample&);
template Readings rounded_configuration<vt>(const AuditSample&);
template Readings rounded_configuration<ee>(const AuditSample&);
template Readings rounded_cubic<vt>(const AuditSample&);
template Readings rounded_cubic<ee>(const AuditSample&);

}  // namespace nearmiss::audit_parts
