// Errors of the templates of ccd/ for one sample: those that the rules allow, and the actual errors.
#pragma once

#include <vector>

#include "fuzz/studies/audit/samples.hpp"

namespace nearmiss::audit_parts {

/// The errors of one row for one sample.
struct Reading {
  double derived;
  double seen;
  ErrorBound bound{};
  bool by_the_rules = true;  ///< seen <= derived holds for every reading, not only for the maxima of all
};
using Readings = std::vector<Reading>;

/// §4.2: m, n, the time, F² at the computed time compared with F² at the exact time, and the comparison.
Readings vertex_vertex_time(const AuditSample& s);
/// §4.2: only the comparison.
Readings far_vertices(const AuditSample& s);

/// §4.3: the squared length, a weight, its comparison, and F_0ij.
Readings near_edge(const AuditSample& s);
/// The residuals of the roots of case 4 in the exact quadratics.
Readings quadratic_residual(const AuditSample& s);
/// How much the minimum of F_0ij is below its value at the best candidate, in units of B²ε^½. It has two
/// readings, for G and for F.
Readings missed_minimum(const AuditSample& s);

/// §4.4: the coefficients a and d, then b and c.
Readings coefficients(const AuditSample& s);
Readings cubic_value(const AuditSample& s);
/// |F| at the roots that a solver without a threshold finds.
Readings cubic_residual(const AuditSample& s);

/// §4.4, §4.5: the area, the height, a weight and its comparison with N·N.
template <Kind kind>
Readings exact_configuration(const AuditSample& s);
/// §4.5: only a weight and its comparison.
Readings far_configuration(const AuditSample& s);
/// The same four for a query's own vectors, including their rounding; the last one occurs twice.
template <Kind kind>
Readings rounded_configuration(const AuditSample& s);
/// F(t), its clearance from 0, and B for a query's own vectors, including their rounding.
template <Kind kind>
Readings rounded_cubic(const AuditSample& s);

/// §5: how far a weight moves if p moves by B h in each component. A weight is linear in p, so this is the
/// weight of a configuration with p = B h. It is at most ‖N‖ ‖edge‖ √3 B h, with ‖N‖ <= ‖q‖ ‖r‖ <= 3B² and
/// ‖edge‖ <= √3 B.
Readings weight_spread(const AuditSample& s);

}  // namespace nearmiss::audit_parts
