// Relative vectors for the audit, as doubles and as exact numbers.
#pragma once

#include <boost/multiprecision/gmp.hpp>
#include <optional>

#include "ccd/audited.hpp"
#include "fuzz/random.hpp"

namespace nearmiss::audit_parts {

namespace mp = boost::multiprecision;
using Rational = mp::number<mp::gmp_rational, mp::et_off>;
using AuditedRational = Audited<Rational>;

/// Three moving vectors, a time, and a bound B of q and r at all times; p is within `reach` B. The vectors
/// are those of a query, or arbitrary vectors, which then count as exact.
struct AuditSample {
  Moving<double> p, q, r;
  double t = 0;
  double B = 1;
  double eta = 1, S = 1;  ///< thresholds that are factors in a comparison, at most B
  double reach = 1;
  std::optional<Query> query;  ///< the query of the vectors, in its own unit of length

  [[nodiscard]] bool within_bounds() const;
};

/// Random vectors with components up to 1, as a starting point of a hill climb.
AuditSample draw_sample(Random& random, double reach);
/// A random step from a sample.
AuditSample changed(Random& random, const AuditSample& sample);
/// The relative vectors of a query with a random time; nothing if they are not within the bounds.
std::optional<AuditSample> sample_of(const Query& query, Random& random);

/// A computed vector that counts as exact (§4).
Moving<AuditedRational> exactly(const Moving<double>& vector, double reach = 1);

/// The vector x_a - x_b of a query with its rounding (§5), in units of u. A position has one rounding, and a
/// velocity has three of B (two positions and their difference). Both differences x_a - x_b are within B.
Moving<AuditedRational> rounded(const Query& query, int a, int b);

/// The vectors on which F(t) and the configuration depend.
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

/// An exact time in [0, 1].
inline AuditedRational exact_time(double t) { return {t, t, {1, 0, 0}}; }

/// An exact threshold of at most B^degree.
inline AuditedRational threshold(double value, int degree) { return {value, value, {1, degree, 0}}; }

}  // namespace nearmiss::audit_parts
