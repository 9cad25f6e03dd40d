// The rounding errors of ccd/ at given inputs, and the search for the largest errors.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/random.hpp"
#include "tests/proofs/claims.hpp"
#include "tests/proofs/climb.hpp"
#include "tests/proofs/numbers.hpp"
#include "tests/proofs/program.hpp"

namespace nearmiss::proofs {

/// Measures the rounding errors of a problem that is computed in double. The pair's bound B is the smallest
/// value for which the inputs are within bounds.
class Measure {
 public:
  explicit Measure(const CcdClaim& claim);

  /// The exact error in the claim's unit, truncated to double; nothing if the inputs are out of bounds for
  /// every B.
  [[nodiscard]] std::optional<double> error(const Inputs& inputs) const { return measured<Rational>(inputs); }
  /// A quick estimate of the error, in long double.
  [[nodiscard]] std::optional<double> estimate(const Inputs& inputs) const {
    return measured<long double>(inputs);
  }

  /// Whether `inputs` has the names of all inputs of the problem.
  [[nodiscard]] bool has_inputs(const Inputs& inputs) const;

  /// Random inputs, which may be out of bounds.
  [[nodiscard]] Inputs drawn(Random& random) const;
  [[nodiscard]] Inputs changed(Random& random, const Inputs& inputs) const;

 private:
  struct Limit {
    int index;
    double lowest, highest;
    int degree;
  };

  void limit(const Traced& expression, double lowest, double highest, int degree);
  [[nodiscard]] double draw(Random& random, const std::string& name) const;
  void choose_bound(Inputs& inputs) const;
  template <class Number>
  [[nodiscard]] std::optional<double> measured(const Inputs& inputs) const;
  template <class Number>
  [[nodiscard]] std::vector<Number> results(const Inputs& inputs) const;
  template <class Number>
  [[nodiscard]] Number smallest_bound(const std::vector<Number>& exact) const;

  Program program_;
  int left_, right_, degree_;
  bool vectors_alone_;
  std::vector<int> vectors_;          ///< indices of the components of the motions
  std::map<int, std::string> given_;  ///< exact numbers that are not inputs, by index
  std::vector<Limit> limits_;
  std::vector<std::string> names_;
};

/// The witness with the largest error that hill climbs find when they start from random inputs and, unless
/// `known` is empty, from `known`.
Witness find_witness(const CcdClaim& claim, const Inputs& known, const ClimbEffort& effort);
Witness find_witness(const OracleClaim& claim, const Inputs& known, const ClimbEffort& effort);

}  // namespace nearmiss::proofs
