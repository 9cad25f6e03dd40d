// Errors of the templates of ccd/ on one sample: those that the rules allow, and the actual ones.
#pragma once

#include <vector>

#include "fuzz/studies/audit/samples.hpp"

namespace nearmiss::audit_parts {

/// The errors of one row on one sample.
struct Reading {
  double derived;
  double seen;
  ErrorBound bound{};
  bool by_the_rules = true;  ///< seen <= derived holds for each reading; else only for the maxima of all
};
using Readings = std::vector<Reading>;

/// §4.2: m, n, the time, F² at the computed time against F² at the exact one, and the comparison.
Readings vertex_vertex_time(const AuditSample& s);
/// Only the comparison.
Readings far_vertices(const AuditSample& s);

/// §4.3: squared length, weight, its comparison, F_0ij.
Readings near_edge(const AuditSample& s);
/// The residual of the roots of case 4 in the exact quadratics.
Readings quadratic_residual(const AuditSample& s);
/// How much lower F_0ij is somewhere than at the best candidate, in B²ε^½, twice: for G and for F.
Readings missed_minimum(const AuditSample& s);

/// §4.4: a and d, b and c.
Readings coefficients(const AuditSample& s);
Readings cubic_value(const AuditSample& s);
/// |F| at the roots that a solver without a threshold finds.
Readings cubic_residual(const AuditSample& s);

/// §4.4, §4.5: area, height, weight and its comparison with N·N.
template <Kind kind>
Readings exact_configuration(const AuditSample& s);
/// Only weight and comparison.
Readings far_configuration(const AuditSample& s);
/// The same four for a query's own vectors, with their rounding; the last twice.
template <Kind kind>
Readings rounded_configuration(const AuditSample& s);
/// F(t), its clearance from 0, and B, likewise.
template <Kind kind>
Readings rounded_cubic(const AuditSample& s);

/// §5: how far a weight moves when p moves by B h in each component. A weight is linear in p, so that is the weight of
/// a configuration with p = B h: at most ‖N‖ ‖edge‖ √3 B h, with ‖N‖ <= ‖q‖ ‖r‖ <= 3B² and ‖edge‖ <= √3 B.
Readings weight_spread(const AuditSample& s);

}  // namespace nearmiss::audit_parts
