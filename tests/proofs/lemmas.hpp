// The lemmas with which a proof by Gappa begins.
#pragma once

#include <map>
#include <set>
#include <string>

#include "tests/proofs/gappa.hpp"
#include "tests/proofs/script.hpp"

namespace nearmiss::proofs {

/// A range that Gappa found: lowest and highest value, rounded outwards to double.
struct ProvenRange {
  double lowest, highest;
  [[nodiscard]] double magnitude() const { return std::max(-lowest, highest); }
};

/// The ranges that Gappa printed, by expression.
std::map<std::string, ProvenRange> bounds_in(const std::string& output);

/// The lemmas of one problem. Each lemma is proven when it is made.
class Lemmas {
 public:
  Lemmas(Prover& prover, const Problem& problem, const Arithmetic& arithmetic);

  /// The script with all operations that are not in a lemma. `goal` is the interval that is to be proven for
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
