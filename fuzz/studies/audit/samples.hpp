// What the audit computes with: relative vectors in double and, to the last bit, what they stand for.
#pragma once

#include <boost/multiprecision/gmp.hpp>
#include <optional>

#include "ccd/audited.hpp"
#include "fuzz/random.hpp"

namespace nearmiss::audit_parts {

namespace mp = boost::multiprecision;
using Rational = mp::number<mp::gmp_rational, mp::et_off>;
using AuditedRational = Audited<Rational>;

/// Three moving vectors, a time, and the bound B that holds for all of them at all times, but for p, which is
/// within `reach` B. Made of a query, or of any vectors, which then are exact.
struct AuditSample {
  Moving<double> p, q, r;
  double t = 0;
  double B = 1;
  double eta = 1, S = 1;  ///< thresholds that are factors: at most B
  double reach = 1;
  std::optional<Query> query;  ///< that they are the relative vectors of, in its own unit of length

  [[nodiscard]] bool within_bounds() const;
};

/// Vectors with components up to 1, that one hill climb or another begins with.
AuditSample draw_sample(Random& random, double reach);
/// A step from it.
AuditSample changed(Random& random, const AuditSample& sample);
/// The relative vectors of a query with a random time, where they are within bounds.
std::optional<AuditSample> sample_of(const Query& query, Random& random);

/// A computed vector taken as exact (§4).
Moving<AuditedRational> exactly(const Moving<double>& vector, double reach = 1);

/// The same with the rounding that made it from the coordinates (§5), in units of u: a position has one, a
/// velocity three of B (two positions and their difference). Both differences x_a - x_b are within B.
Moving<AuditedRational> rounded(const Query& query, int a, int b);

/// F(t) and the configuration are functions of these.
template <Kind kind>
Pair<kind, AuditedRational> exact_pair(const AuditSample& s) {
  Pair<kind, AuditedRational> pair;
  pair.p = exactly(s.p, s.reach);
  pair.q = exactly(s.q);
  pair.r = exactly(s.r);
  return pair;
}
template <Kind kind>
Pair<kind, AuditedRational> rounded_pair(const Query& query) {
  constexpr bool vt = kind == Kind::vertex_triangle;
  Pair<kind, AuditedRational> pair;
  pair.p = vt ? rounded(query, 0, 1) : rounded(query, 2, 0);
  pair.q = vt ? rounded(query, 2, 1) : rounded(query, 1, 0);
  pair.r = vt ? rounded(query, 3, 1) : rounded(query, 3, 2);
  return pair;
}

/// A time in [0, 1].
inline AuditedRational exact_time(double t) { return {t, t, {1, 0, 0}}; }

/// A threshold of a degree, exact, that is at most B^degree.
inline AuditedRational threshold(double value, int degree) { return {value, value, {1, degree, 0}}; }

}  // namespace nearmiss::audit_parts
