// A bound to be proved about an expression.
#pragma once

#include <memory>
#include <vector>

#include "ccd/motion.hpp"
#include "tests/proofs/traced.hpp"

namespace nearmiss::proofs {

/// A vector x(t) = x + t v and bounds of what it stands for, in units of B, for every component.
struct BoundedMotion {
  Moving<Traced> vector;
  double start = 1, end = 1;  ///< of |x(0)|, |x(1)|, and so of all |x(t)| the larger one
  double velocity = 1;        ///< of |v|
};

/// An exact value within [lowest, highest] B^degree.
struct BoundedExpression {
  Traced expression;
  double lowest, highest;
  int degree;
};

/// How far the computed value of an expression, or the computed difference of the two sides of a comparison,
/// is from the exact one, for all inputs within bounds.
///
/// Everything in it is homogeneous, so that one proof for B = 1 is a proof for every B: a power of two
/// changes no rounding, and relative errors do not depend on the place within a binade.
struct Problem {
  std::shared_ptr<Trace> trace;  ///< of the inputs
  Traced time;
  std::vector<BoundedMotion> motions;     ///< of coordinates that are inputs, or with x and v as inputs
  std::vector<BoundedExpression> inputs;  ///< exact numbers
  /// Facts about expressions of these that interval arithmetic does not see.
  std::vector<BoundedExpression> facts;
  Traced left, right;  ///< the error of left - right, where the subtraction itself is not rounded
  int degree = 0;      ///< in units of B^degree
};

}  // namespace nearmiss::proofs
