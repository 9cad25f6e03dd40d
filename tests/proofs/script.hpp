// The text of one Gappa script.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/proofs/gappa.hpp"

namespace nearmiss::proofs {

/// A number in Gappa's exact notation: "3", or "3b-2" for 3/4.
std::string dyadic(double number);
/// "[lowest, highest]".
std::string interval(double lowest, double highest);

/// Hypotheses about a number that a script does not compute.
struct Leaf {
  double lowest, highest;  ///< range of the exact value
  enum class ErrorKind : std::uint8_t { none, relative, absolute } kind = ErrorKind::none;
  double error = 0;  ///< bound of the error
};

/// The instructions of a program in a Gappa script. For instruction 7, the exact value has the name e7, and
/// the computed value c7 (or e7 if the instruction is exact).
class Script {
 public:
  Script(const Program& program, const Arithmetic& arithmetic, std::map<int, Leaf> leaves,
         std::map<int, Leaf> facts)
      : program_(program), arithmetic_(arithmetic), leaves_(std::move(leaves)), facts_(std::move(facts)) {}

  /// Writes an instruction and all instructions that it depends on, down to the leaves.
  void write(int index);
  /// Defines d as the error of left - right, the difference of the results of two instructions. The script
  /// must already have these instructions. The subtraction itself is exact.
  void difference(int left, int right);

  [[nodiscard]] std::string computed(int index) const;
  /// The names of the computed values that are not exact.
  [[nodiscard]] std::vector<std::string> results() const;
  static std::string exact(int index);

  [[nodiscard]] std::string text(const std::vector<std::string>& goals) const;

 private:
  void write_leaf(int index, const Leaf& leaf);
  void write_constant(int index, double value);
  void write_operation(int index);
  void rounded(int index, const std::string& result);
  void unrounded(int index, const std::string& result);
  void suppose(const std::string& expression, double lowest, double highest);
  void define(const std::string& name, const std::string& expression);

  const Program& program_;
  Arithmetic arithmetic_;
  std::map<int, Leaf> leaves_, facts_;
  std::set<int> written_, inexact_;
  std::vector<std::string> definitions_, hypotheses_, hints_;
};

}  // namespace nearmiss::proofs
