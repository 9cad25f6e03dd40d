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

/// Results of templates at given inputs, computed in Number and exactly.
///
/// The inputs are components of vectors ("b0y"), lower halves of double words ("b0y.lo", 0 if not given), and
/// times t and s.
template <class Number>
class ResultsAt {
 public:
  explicit ResultsAt(Results results);

  /// The largest |computed - exact| of all results, in units of `unit`.
  [[nodiscard]] double error(const Inputs& inputs, const Rational& unit) const;
  /// The largest magnitude of all results, including those of single operations, that have a component of
  /// every vector as a factor, in units of `unit`.
  [[nodiscard]] double reach(const Inputs& inputs, const Rational& unit) const;

 private:
  [[nodiscard]] int degree(int instruction) const;

  std::shared_ptr<Trace> trace_ = std::make_shared<Trace>();
  Program program_;
  std::vector<int> results_;
};

/// A of component x of a (step_part.hpp): the larger of its magnitudes at both ends.
Rational A_of(const Inputs& inputs);
/// w of component x of b × c (step_part.hpp).
Rational w_of(const Inputs& inputs);
/// M of F (step_part.hpp).
Rational M_of(const Inputs& inputs);

/// Draws components of some vectors in [-1, 1] and two times, of which t is the earlier one. The components
/// are 0 or ±1, have nearly the same magnitude, or have any magnitudes. With `words`, each component also has
/// a lower half within half an ulp.
Inputs draw_vectors(Random& random, const std::string& vectors, bool words = false);

}  // namespace nearmiss::proofs
