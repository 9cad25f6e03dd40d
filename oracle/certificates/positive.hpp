// Signs of polynomials on intervals, according to the tests that the checkers of certificates use.
#pragma once

#include <algorithm>

#include "oracle/exact/root.hpp"

namespace nearmiss::certificates {

/// Whether all Bernstein coefficients of p on [lo, hi] are positive. If the interval is open at hi, only the
/// first coefficient needs to be positive; the others may be 0.
inline bool is_positive(const exact::Polynomial& p, const exact::Number& lo, const exact::Number& hi,
                        bool is_open = false) {
  if (p.is_zero()) return false;
  const exact::OnInterval on(p, lo, hi);
  const exact::Numbers& c = on.coefficients();
  return sign(c[0]) > 0 && std::all_of(c.begin() + 1, c.end(), [&](const exact::Number& each) {
           return sign(each) >= (is_open ? 0 : 1);
         });
}

/// Whether no Bernstein coefficient of p on [lo, hi] is negative.
inline bool is_nowhere_negative(const exact::Polynomial& p, const exact::Number& lo,
                                const exact::Number& hi) {
  if (p.is_zero()) return true;
  const exact::OnInterval on(p, lo, hi);
  return std::ranges::all_of(on.coefficients(), [](const exact::Number& each) { return sign(each) >= 0; });
}

}  // namespace nearmiss::certificates
