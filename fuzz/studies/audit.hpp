// The rounding constants of Wang's paper and of ccd/. For each constant, this file has the value that the
// paper or ccd/ states, the value that follows from the paper's Theorem 4.1, and the value that a proof shows
// to be sufficient.
#pragma once

#include <limits>
#include <string_view>
#include <vector>

#include "ccd/wang/bounds/tight_tolerances.hpp"

namespace nearmiss {

/// One constant. A number that is not known is NaN.
struct RoundingConstant {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  std::string_view name;     ///< unique
  std::string_view section;  ///< section of the paper; for a constant of ours, its identifier and file
  std::string_view unit;
  double quoted = none;  ///< the constant's value in the paper; for a constant of ours, its value in ccd/

  /// For a bound (rounding_bounds): the first-order bound that Theorem 4.1 gives for the operations in ccd/
  /// if the vectors have no rounding errors. For a consequence (rounding_consequences): the value that
  /// follows from other rows.
  double derived = none;
  /// The bound that Gappa proves for rounding to nearest, including the rounding of the vectors
  /// (ccd/wang/bounds/proven.hpp).
  double proven = none;
  std::string_view note{};

  /// Whether neither the theorem nor a proof shows that the constant is large enough.
  [[nodiscard]] bool is_too_small() const {
    return quoted > 0 && !(derived <= quoted) && !(proven <= quoted);
  }
  /// Whether the constant is proven to be large enough, although the theorem does not show this.
  [[nodiscard]] bool needs_proof() const { return derived > quoted && proven <= quoted; }
  [[nodiscard]] double slack() const { return quoted / derived; }
};

/// Bounds of rounding errors. tests/proofs/ checks each row: the theorem gives `derived`, and Gappa proves
/// `proven`.
std::vector<RoundingConstant> rounding_bounds();

/// Constants that follow from the bounds in rounding_bounds() or from other constants.
std::vector<RoundingConstant> rounding_consequences();

/// The tolerances for the machine epsilon 2^exponent. Lengths are in units of B ε^¼.
struct ToleranceRow {
  int exponent = 0;
  std::string_view scalar;
  ToleranceConstants tight{};  ///< the smallest tolerances that satisfy all constraints
  double paper_bound = 0;      ///< the distance bound of the paper's closed forms
  double tight_bound = 0;      ///< the distance bound of the smallest tolerances
  /// The first constraint that the paper's closed forms violate; empty if they violate none.
  std::string_view paper_breaks;
  /// Like paper_breaks, but computed with the rounding errors that the paper states.
  std::string_view printed_breaks;
};

/// One row for each of 16 scalars, whose precisions are from 11 to 256 bits.
std::vector<ToleranceRow> tolerance_table();

}  // namespace nearmiss
