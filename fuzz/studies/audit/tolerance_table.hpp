// The distance bounds that the tolerances promise for each machine epsilon.
#pragma once

#include <string_view>
#include <vector>

#include "ccd/constraints.hpp"
#include "ccd/tight_tolerances.hpp"

namespace nearmiss {

/// The bounds of the paper's closed forms and of the smallest tolerances for ε = 2^exponent. Lengths are in
/// units of B ε^¼.
struct ToleranceRow {
  int exponent = 0;
  std::string_view scalars;
  ToleranceConstants tight{};
  double paper_bound = 0;
  double tight_bound = 0;
  double relative_bound = 0;        ///< the bound of the smallest tolerances in units of B
  std::string_view paper_breaks;    ///< the first constraint that the closed forms violate; empty if none
  std::string_view printed_breaks;  ///< the same with the errors that the paper states
};

std::vector<ToleranceRow> tolerance_table();

/// The best E for the constraints: E² = 4 (R² - r²), with R² = S²/8 as in `constraints`.
template <class Number>
Number longest_short_edge(const Tolerances<Number>& tol, const RoundingErrors<Number>& errors) {
  using std::sqrt;
  const Number r = (tol.mu + errors.residual) / (tol.tau - errors.area);
  return sqrt(tol.S * tol.S / 8 - r * r) * 2 * (1 - 0x1p-40);
}

}  // namespace nearmiss
