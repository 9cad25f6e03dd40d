// The exact errors of the filter's arithmetic at given inputs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fuzz/random.hpp"
#include "tests/proofs/numbers.hpp"
#include "tests/proofs/oracle_proofs.hpp"
#include "tests/proofs/witness.hpp"

namespace nearmiss::proofs {

/// Evaluates the results of the oracle's templates at given inputs, both in the arithmetic of Number and
/// exactly.
///
/// The inputs are components of vectors ("b0y"), lower halves of double words ("b0y.lo", 0 if not given), and
/// times t and s.
template <class Number>
class ResultsAt {
 public:
  explicit ResultsAt(Results results);

  /// The largest |computed - exact| of all results, in units of `unit`.
  [[nodiscard]] double error(const Inputs& inputs, const Rational& unit) const;
  /// The largest magnitude, in units of `unit`, of those intermediate results that have a component of every
  /// vector as a factor.
  [[nodiscard]] double reach(const Inputs& inputs, const Rational& unit) const;

 private:
  [[nodiscard]] int degree(int instruction) const;

  std::shared_ptr<Trace> trace_ = std::make_shared<Trace>();
  Program program_;
  std::vector<int> results_;
};

/// A_x (step_part.hpp): the larger of the magnitudes of component x of the vector a at both ends of the part
/// of the step.
Rational A_of(const Inputs& inputs);
/// w (step_part.hpp) of component x of b × c: B_y C_z + B_z C_y, with the magnitudes B and C of b and c.
Rational w_of(const Inputs& inputs);
/// M (step_part.hpp): the sum of A_k w_k over all three components.
Rational M_of(const Inputs& inputs);

/// Draws components of some vectors in [-1, 1] and two times t <= s. The components are 0 or ±1, or have
/// magnitudes near 1, or are distributed uniformly. With `words`, each component also has a lower half within
/// half an ulp.
Inputs draw_vectors(Random& random, const std::string& vectors, bool words = false);

}  // namespace nearmiss::proofs
