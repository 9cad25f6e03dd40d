// An expression whose rounding error is to be bounded.
#pragma once

#include <memory>
#include <vector>

#include "ccd/wang/motion.hpp"
#include "tests/proofs/traced.hpp"

namespace nearmiss::proofs {

/// A vector x(t) = x + t v, with bounds of the exact components in units of the pair's bound B.
struct BoundedMotion {
  Moving<Traced> vector;
  double start = 1, end = 1;  ///< bounds of |x(0)| and |x(1)|; the larger one bounds all |x(t)|
  double velocity = 1;        ///< bound of |v|
};

/// An expression whose exact value is in [lowest, highest] B^degree.
struct BoundedExpression {
  Traced expression;
  double lowest, highest;
  int degree;
};

/// The problem of bounding an error for all inputs within their bounds. The error is that of an expression,
/// or that of the difference of the two sides of a comparison.
///
/// All expressions are homogeneous in the lengths, so a proof for B = 1 is a proof for every B: scaling by a
/// power of two changes no rounding, and the bound of relative errors is the same everywhere in a binade.
struct Problem {
  std::shared_ptr<Trace> trace;  ///< trace of the inputs
  Traced time;
  std::vector<BoundedMotion> motions;     ///< motions whose coordinates are inputs, or whose x and v are
                                          ///< inputs
  std::vector<BoundedExpression> inputs;  ///< exact numbers
  /// Facts about expressions of the inputs that interval arithmetic cannot derive.
  std::vector<BoundedExpression> facts;
  Traced left, right;  ///< the problem is the error of left - right; the subtraction itself is not rounded
  int degree = 0;      ///< the error is in units of B^degree
};

}  // namespace nearmiss::proofs
