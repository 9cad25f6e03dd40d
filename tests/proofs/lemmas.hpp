// The lemmas with which a proof by Gappa begins.
#pragma once

#include <map>
#include <set>
#include <string>

#include "tests/proofs/gappa.hpp"
#include "tests/proofs/script.hpp"

namespace nearmiss::proofs {

/// The range that Gappa found for an expression: the lowest and the highest value of the expression, rounded
/// outwards to double.
struct ProvenRange {
  double lowest, highest;
  [[nodiscard]] double magnitude() const { return std::max(-lowest, highest); }
};

/// Maps each expression in Gappa's output to the range that Gappa printed for this expression.
std::map<std::string, ProvenRange> bounds_in(const std::string& output);

/// The lemmas of one problem. Gappa proves each lemma when the lemma is made.
class Lemmas {
 public:
  Lemmas(Prover& prover, const Problem& problem, const Arithmetic& arithmetic);

  /// The script with all operations that belong to no lemma. `goal` is the interval that is to be proven for
  /// the error d.
  std::string last_script(const std::string& goal) { return last().text({"d in " + goal}); }
  /// The script whose goals are the ranges of the error and of all results.
  std::string script_of_bounds();

 private:
  Script last();
  void know_motion(const BoundedMotion& motion, const Traced& time);
  void know_extremes();
  void know_extreme(int index);
  std::set<int> needed();
  void operands(int index, std::set<int>& found);
  ProvenRange range(int index, const std::map<int, ProvenRange>& operands);
  [[nodiscard]] Script script() const { return {program_, arithmetic_, leaves_, facts_}; }

  Prover& prover_;
  Arithmetic arithmetic_;
  Program program_;
  int left_, right_;
  std::map<int, Leaf> leaves_, facts_;
};

}  // namespace nearmiss::proofs
