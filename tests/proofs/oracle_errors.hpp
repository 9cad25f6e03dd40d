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
  /// The largest magnitude of all results that have a component of every vector as a factor, in units of
  /// `unit`.
  [[nodiscard]] double reach(const Inputs& inputs, const Rational& unit) const;

 private:
  [[nodiscard]] int degree(int instruction) const;

  std::shared_ptr<Trace> trace_ = std::make_shared<Trace>();
  Program program_;
  std::vector<int> results_;
};

/// The magnitude of component x of a; the w of component x of b × c; and M.
Rational A_of(const Inputs& inputs);
Rational w_of(const Inputs& inputs);
Rational M_of(const Inputs& inputs);

/// Draws components of some vectors in [-1, 1] and two times, of which t is the earlier one. The components
/// have few bits, the same magnitude, or any magnitudes. Lower halves of `words` are within half an ulp.
Inputs draw_vectors(Random& random, const std::string& vectors, bool words = false);

}  // namespace nearmiss::proofs
