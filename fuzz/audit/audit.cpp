#include "fuzz/audit/audit.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <tuple>

#include "ccd/cubic.hpp"
#include "ccd/proximity.hpp"
#include "ccd/ve_culling.hpp"
#include "ccd/vertex_edge.hpp"
#include "fuzz/audit/samples.hpp"
#include "fuzz/families/families.hpp"

namespace nearmiss {

namespace {

using audit_parts::exact_pair;
using audit_parts::exact_time;
using audit_parts::exactly;
using audit_parts::Number;
using audit_parts::Rational;
using audit_parts::rounded_pair;
using audit_parts::Sample;
using audit_parts::threshold;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double eps = epsilon<double>;
constexpr Kind vt = Kind::vertex_triangle;
constexpr Kind ee = Kind::edge_edge;

/// What one sample says of one row.
struct Reading {
  double derived;
  double seen;
  ErrorBound bound{};
  bool by_the_rules = true;  ///< seen must not be above derived in each reading; else only in all together
};

double magnitude(const Rational& x) { return std::abs(static_cast<double>(x)); }

/// A value, with operations that err by ω = roundings ε.
Reading reading(const Number& f, const Sample& s, double omega = 1) {
  const ErrorBound& bound = f.bound();
  return {omega * bound.error(), magnitude(f.error()) / (std::pow(s.B, bound.degree) * eps), bound};
}

/// Both sides of a comparison.
using Comparison = std::pair<Number, Number>;
Reading reading(const Comparison& c, const Sample& s, double omega = 1) {
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

using Readings = std::vector<Reading>;
using Comparisons = std::vector<Comparison>;

Tolerances<Number> thresholds(const Sample& s) {
  Tolerances<Number> tol{};
  for (Number* area : {&tol.tau, &tol.psi, &tol.lambda2, &tol.D2, &tol.delta, &tol.rho})
    *area = threshold(0, 2);
  tol.eta = threshold(s.eta, 1);
  tol.S = threshold(s.S, 1);
  return tol;
}

// Each of the following runs a template of ccd/ and reads what some rows ask for.

/// The computed coefficients, taken as exact.
Cubic<Number> as_exact(const Cubic<Number>& F) {
  const auto exact = [](const Number& c) {
    return Number(c.value(), c.value(), {c.bound().coefficient, c.bound().degree, 0});
  };
  return {exact(F.a), exact(F.b), exact(F.c), exact(F.d)};
}

Readings coefficients(const Sample& s) {
  const auto F = coplanarity(exact_pair<vt>(s));
  return {larger(reading(F.a, s), reading(F.d, s)), larger(reading(F.b, s), reading(F.c, s))};
}

Readings cubic_value(const Sample& s) {
  return {reading(coplanarity(exact_pair<vt>(s))(exact_time(s.t)), s)};
}

/// Area, height, weight and its comparison with N·N.
template <Kind kind>
Readings figure(const Pair<kind, Number>& pair, const Sample& s, double omega) {
  const Figure<kind, Number> figure(pair, exact_time(s.t));
  Comparisons kept;
  const ComparisonLog<Rational> log(kept);
  std::ignore = figure.well_shaped(thresholds(s), log);
  const Reading area = reading(kept.at(0), s, omega);
  const Reading height = reading(kept.at(1), s, omega);
  kept.clear();
  std::ignore = figure.inside(log);
  // Of a triangle the third is the sum of the others, whose comparison is the worst.
  Reading weight = larger(reading(kept.at(0), s, omega), reading(kept.at(2), s, omega));
  Reading criterion = larger(reading(kept.at(1), s, omega), reading(kept.at(3), s, omega));
  if constexpr (kind == vt) criterion = larger(criterion, reading(kept.at(5), s, omega));
  return {area, height, weight, criterion};
}
template <Kind kind>
Readings exact_figure(const Sample& s) {
  return figure(exact_pair<kind>(s), s, 1);
}
Readings far_figure(const Sample& s) {
  const Readings all = exact_figure<ee>(s);
  return {all[2], all[3]};
}
template <Kind kind>
Readings rounded_figure(const Sample& s) {
  Readings all = figure(rounded_pair<kind>(*s.query), s, 0.5);
  all.push_back(all.back());  // as `weight_error`
  return all;
}

/// F(t), its clearance from 0, B.
template <Kind kind>
Readings rounded_cubic(const Sample& s) {
  auto pair = rounded_pair<kind>(*s.query);
  const auto F = coplanarity(pair);
  detail::form_bound(pair);
  return {reading(F(exact_time(s.t)), s, 0.5), reading(clearance(as_exact(F)), s, 0.5),
          reading(pair.B, s, 0.5)};
}

/// Squared length, weight, its comparison, F_0ij.
Readings near_edge(const Sample& s) {
  const Moving<Number> a = exactly(s.p, s.reach);
  Comparisons kept;
  detail::near_edge(VertexEdge<Number>{a, exactly(s.q), a}, exact_time(s.t), thresholds(s),
                    ComparisonLog<Rational>(kept));
  return {reading(kept.at(0), s), reading(kept.at(1), s), reading(kept.at(2), s), reading(kept.at(3), s)};
}

/// The residual of the roots of case 4 in the exact quadratics.
Readings quadratic_residual(const Sample& s) {
  const double rho = 3 * std::sqrt(eps) * s.B * s.B;
  const detail::CrossProduct<Number> g(exactly(s.p, s.reach), exactly(s.q), threshold(rho, 2));
  double kappa = 0;
  double seen = 0;
  for (int k = 0; k < 3; ++k) {
    const auto& [a, b, c] = std::tie(g.a[k], g.b[k], g.c[k]);
    kappa = std::max(kappa, a.bound().error() + b.bound().error() + c.bound().error() +
                                quadratic_error(a.bound().coefficient, c.bound().coefficient));
    if (b.exact() * b.exact() < 4 * a.exact() * c.exact()) continue;  // no root to be missed
    Times<double, 2> times;
    solve_quadratic(times, a.value(), b.value(), c.value());
    for (const double t : times) {
      const Rational residual = (a.exact() * t + b.exact()) * t + c.exact();
      seen = std::max(seen, magnitude(residual) / (s.B * s.B * eps));
    }
  }
  return {{kappa, seen}};
}

/// How much lower F_0ij is somewhere than at the best of all candidates, in B²ε^½; in double, which is enough.
Readings missed_minimum(const Sample& s) {
  const double kappa = quadratic_residual(s)[0].derived;
  const double unit = s.B * s.B * std::sqrt(eps);
  const double S = 18 * s.B * std::sqrt(std::sqrt(eps));
  const auto F = [&](double t) {
    const Vector3<double> e = s.q.at(t);
    return s.p.at(t).cross(e).lpNorm<1>() - S * max_component(e);
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
  for (double step = 1.0 / places; step > 1e-12; step /= 2) {
    const double middle = at;
    try_time(middle - step);
    try_time(middle + step);
  }
  const double seen = (best - lowest) / unit;
  return {{kink_rise(kappa, 3), seen, {}, false}, {psi_needed(kappa, 3), seen, {}, false}};
}

/// m, n, t, F² at the computed time against F² at the exact one, and the comparison (§4.2).
Readings vertex_vertex_time(const Sample& s) {
  const Moving<Number> ji = exactly(s.p, s.reach);
  const Reading m = reading(ji.x().dot(ji.v()), s);
  const Reading n = reading(ji.v().dot(ji.v()), s);
  Comparisons kept;
  const auto t = vertex_vertex(ji, thresholds(s), ComparisonLog<Rational>(kept));
  const Number& squared = kept.at(0).first;
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

Readings far_vertices(const Sample& s) { return {vertex_vertex_time(s).back()}; }

/// What a solver without a threshold leaves of F at its roots.
Readings cubic_residual(const Sample& s) {
  const auto F = coplanarity(exact_pair<vt>(s));
  const Cubic<Number> taken = as_exact(F);
  double coefficients = 0;
  for (const Number* c : {&F.a, &F.b, &F.c, &F.d}) coefficients += c->bound().error();
  const double horner = taken(exact_time(s.t)).bound().error();
  double seen = 0;
  const Cubic<double> computed{F.a.value(), F.b.value(), F.c.value(), F.d.value()};
  for (const double t : solve_cubic(computed, 0.0)) {
    const Rational value = ((F.a.exact() * t + F.b.exact()) * t + F.c.exact()) * t + F.d.exact();
    seen = std::max(seen, magnitude(value) / (s.B * s.B * s.B * eps));
  }
  return {
      {cubic_error(coefficients, horner, taken.a.bound().coefficient, taken.c.bound().coefficient), seen}};
}

/// How far a weight moves when p moves by B h in each component: it is linear in p, so that is the weight of a
/// figure with p = B h. ‖N‖ ‖edge‖ √3 B h, ‖N‖ <= ‖q‖ ‖r‖ <= 3B², ‖edge‖ <= √3 B.
Readings weight_spread(const Sample& s) {
  const auto pair = exact_pair<ee>(s);
  const Figure<ee, Number> figure(pair, exact_time(s.t));
  double seen = 0;
  for (const Number& w : figure.weights) seen = std::max(seen, std::abs(w.value()) / std::pow(s.B, 4));
  return {{9, seen, {}, false}};
}

struct Group {
  std::vector<AuditRow> rows;
  std::function<Readings(const Sample&)> read;
  double reach = 1;            ///< of p, in the hill climb
  std::optional<Kind> kind{};  ///< rows about the rounding of relative vectors: of queries of this kind alone
};

AuditRow quote(std::string_view name, std::string_view section, std::string_view unit, double quoted,
               std::string_view note = "") {
  return {.name = name, .section = section, .unit = unit, .quoted = quoted, .note = note, .bound = {}};
}

constexpr std::string_view beyond = "relative positions of edges are within 2B (§4.1 has B)";
constexpr std::string_view vectors = "with the rounding of relative vectors (§5), to nearest";
constexpr std::string_view appendix = "the paper's appendix is missing; derived in audit.hpp";

std::vector<Group> groups() {
  const auto B2 = "B^2 eps";
  const auto B3 = "B^3 eps";
  const auto B4 = "B^4 eps";
  std::vector<Group> all;
  all.push_back({{quote("VV: m = x.v", "4.2", B2, 3 * 3), quote("VV: n = v.v", "4.2", B2, 3 * 3),
                  quote("VV: time", "4.2", "eps (B/b + 1)", 12),
                  quote("VV: squared distance moved", "4.2", B2, 289), quote("VV: delta", "4.2", B2, 311)},
                 vertex_vertex_time});
  all.push_back({{quote("VV of EE: delta", "4.2", B2, 311, beyond)}, far_vertices, 2});
  all.push_back(
      {{quote("VE: squared length", "4.3", B2, 22), quote("VE: weight", "4.3", B2, 22),
        quote("VE: barycentric test", "4.3", B2, 44), quote("VE: F_0ij", "4.3", B2, nan, "not quoted")},
       near_edge});
  all.push_back(
      {{quote("VE of EE: squared length", "4.3", B2, 22), quote("VE of EE: weight", "4.3", B2, 22, beyond),
        quote("VE of EE: barycentric test", "4.3", B2, 44, beyond),
        quote("VE of EE: F_0ij", "4.3", B2, nan, "not quoted")},
       near_edge,
       2});
  all.push_back({{quote("VE: residual of case 4", "App. A", B2, nan, appendix)}, quadratic_residual});
  all.push_back(
      {{quote("VE of EE: residual of case 4", "App. A", B2, nan, appendix)}, quadratic_residual, 2});
  all.push_back({{quote("VE: G of case 4", "4.3, App. C", "B^2 eps^1/2", 688, appendix),
                  quote("VE: psi", "4.3, App. C", "B^2 eps^1/2", 725, appendix)},
                 missed_minimum});
  all.push_back({{quote("VE of EE: G of case 4", "4.3, App. C", "B^2 eps^1/2", 688, appendix),
                  quote("VE of EE: psi", "4.3, App. C", "B^2 eps^1/2", 725, appendix)},
                 missed_minimum,
                 2});
  all.push_back({{quote("F: a, d", "4.4", B3, 6 * 5), quote("F: b, c", "4.4", B3, 18 * 7)}, coefficients});
  all.push_back({{quote("F(t)", "NOTES 10", B3, 746)}, cubic_value});
  all.push_back({{quote("cubic solver", "4.4, App. B", B3, 33492, appendix)}, cubic_residual});
  all.push_back({{quote("VT: N", "4.4", B2, 13), quote("VT: height test", "4.4", B2, 21),
                  quote("VT: weight", "4.4", B4, 181), quote("VT: barycentric test", "4.4", B4, 565)},
                 exact_figure<vt>});
  all.push_back({{quote("EE: N", "4.5", B2, 13), quote("EE: height test", "4.5", B2, 16),
                  quote("EE: weight", "4.5", B4, 181), quote("EE: barycentric test", "4.5", B4, 362)},
                 exact_figure<ee>});
  all.push_back({{quote("EE: weight, far p", "4.5", B4, 181, beyond),
                  quote("EE: barycentric test, far p", "4.5", B4, 362, beyond)},
                 far_figure,
                 2});
  all.push_back({{quote("VE culling: spread of a weight", "5", "B^4 h", 9)}, weight_spread});
  all.push_back(
      {{quote("VT: N", "4.4", B2, 13, vectors), quote("VT: height test", "4.4", B2, 21, vectors),
        quote("VT: weight", "4.4", B4, 181, vectors), quote("VT: barycentric test", "4.4", B4, 565, vectors),
        quote("weight_error", "ve_culling.hpp", B4, weight_error<double>, vectors)},
       rounded_figure<vt>,
       1,
       vt});
  all.push_back(
      {{quote("EE: N", "4.5", B2, 13, vectors), quote("EE: height test", "4.5", B2, 16, vectors),
        quote("EE: weight", "4.5", B4, 181, vectors), quote("EE: barycentric test", "4.5", B4, 362, vectors),
        quote("weight_error", "ve_culling.hpp", B4, weight_error<double>, vectors)},
       rounded_figure<ee>,
       1,
       ee});
  const auto ours = [&](Kind kind, const auto& read) {
    // The product's B has room for 64 ε and needs 40 ε of it (motion.hpp).
    all.push_back({{quote("F(t)", "ve_culling.hpp", B3, 865, vectors),
                    quote("clearance", "cubic.hpp", B3, 100, vectors),
                    quote("B", "motion.hpp", "B eps", 64 - 40, vectors)},
                   read,
                   1,
                   kind});
  };
  ours(vt, rounded_cubic<vt>);
  ours(ee, rounded_cubic<ee>);
  return all;
}

/// Numbers that follow from others, as the paper has them.
std::vector<AuditRow> consequences(const std::vector<AuditRow>& rows) {
  const auto derived = [&](std::string_view name) {
    return std::find_if(rows.begin(), rows.end(), [&](const AuditRow& row) { return row.name == name; })
        ->derived;
  };
  std::vector<AuditRow> all;
  const auto follows = [&](const AuditRow& row, double value) {
    all.push_back(row);
    all.back().derived = value;
    all.back().seen = nan;
  };
  const auto line = "B^4 eps / (eta N)";
  follows(quote("VV: quotient", "4.2", "eps (B/b + 1)", 10), derived("VV: n = v.v"));
  follows(quote("VV: distance", "4.2", "B eps^1/2", 25), std::sqrt(2.0 * 311));
  follows(quote("VE: psi over lambda", "4.3", "B eps^1/4", 16), 725 / std::sqrt(2080.0));
  follows(quote("VE: lambda^2 over 4", "4.3", "B^2 eps^1/2", 522), (2080 + 22 * std::sqrt(eps)) / 4);
  follows(quote("VT: height test over E", "4.4", "B eps^1/2", 4), 21 / (21.0 / 4));
  follows(quote("EE: height test over E", "4.5", "B eps^1/2", 4), 16 / 4.0);
  follows(quote("VT: distance from an edge line", "4.4", line, 1130), 2 * derived("VT: barycentric test"));
  const double near = derived("EE: barycentric test");
  const double far = derived("EE: barycentric test, far p");
  follows(quote("EE: distance from an edge line", "4.5", line, 724), 2 * near);
  follows(quote("EE: distance from an edge line, far p", "4.5", line, 724, beyond), 2 * far);
  follows(quote("EE: distance of a false positive", "4.5.1", line, 1448), 4 * near);
  follows(quote("EE: distance of a false positive, far p", "4.5.1", line, 1448, beyond), 4 * far);
  follows(quote("distance bound", "4.4.1", "B eps^1/4", 41), std::sqrt(34.0 * 34 + 522));
  follows(quote("critical points", "cubic.hpp", "B^3 eps", 576, "derived in audit.hpp"),
          quadratic_error(3 * 6, 18) + 3 * 6);
  return all;
}

void take(std::vector<AuditRow>& rows, const Readings& readings) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    AuditRow& row = rows[i];
    const Reading& one = readings.at(i);
    if (!(one.derived <= row.derived)) {
      row.derived = one.derived;
      row.bound = one.bound;
    }
    row.seen = std::max(row.seen, one.seen);
    if (one.by_the_rules && one.seen > one.derived) ++row.violations;
  }
}

/// From the best of some, by small steps, to where one row's error is largest.
void climb(Group& group, std::size_t row, const AuditPlan& plan, Random& random) {
  Sample best = audit_parts::draw_sample(random, group.reach);
  double seen = -1;
  for (int i = 0; i < plan.steps; ++i) {
    const bool start = i < plan.steps / 4;
    const Sample next =
        start ? audit_parts::draw_sample(random, group.reach) : audit_parts::changed(random, best);
    const Readings readings = group.read(next);
    take(group.rows, readings);
    if (readings.at(row).seen < seen) continue;
    seen = readings[row].seen;
    best = next;
  }
}

}  // namespace

std::vector<AuditRow> audit(const AuditPlan& plan) {
  std::vector<Group> all = groups();
  for (const Family& family : families()) {
    for (int i = 0; i < plan.queries; ++i) {
      const Query query = make_query(family, plan.seed, static_cast<std::uint64_t>(i));
      Random random(plan.seed, 1, static_cast<std::uint64_t>(i));
      const auto sample = audit_parts::sample_of(query, random);
      if (!sample) continue;
      for (Group& group : all)
        if (!group.kind || *group.kind == query.kind) take(group.rows, group.read(*sample));
    }
  }
  std::vector<AuditRow> rows;
  for (std::size_t g = 0; g < all.size(); ++g) {
    Group& group = all[g];
    for (std::size_t row = 0; row < group.rows.size() && !group.kind; ++row) {
      Random random(plan.seed, 2 + g, row);
      climb(group, row, plan, random);
    }
    rows.insert(rows.end(), group.rows.begin(), group.rows.end());
  }
  const auto others = consequences(rows);
  rows.insert(rows.end(), others.begin(), others.end());
  return rows;
}

}  // namespace nearmiss
