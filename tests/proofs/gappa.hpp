// Proofs of rounding bounds by Gappa (Daumas and Melquiond, "Certification of bounds on expressions involving
// rounded operators", ACM Transactions on Mathematical Software 2010).
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "tests/proofs/gappa_process.hpp"
#include "tests/proofs/problem.hpp"
#include "tests/proofs/program.hpp"

namespace nearmiss::proofs {

/// The arithmetic that a proof is about: every operation is rounded to nearest with `bits` bits, so that its
/// relative error is at most u = 2^-bits.
struct Arithmetic {
  int bits = 53;
  /// If it is set, each product and quotient also errs by up to 2^underflow, for B = 1.
  std::optional<int> underflow{};
  /// Only vectors are rounded, where they are formed; all that is computed with them is exact.
  bool vectors_alone = false;
};

/// Runs Gappa, and keeps its answers, since problems share lemmas. May be used by several threads at once.
///
/// A problem is proven in steps. Lemmas bound, by Gappa too, the error of expressions that occur often, so that the
/// next script has a new variable in their place: a velocity, a position at the time, an expression of maxima, minima
/// and magnitudes (whose error is at most the largest of its operands', since each of these functions changes by at
/// most as much as one of its arguments). The last script has all other operations.
class Prover {
 public:
  /// An upper bound of the problem's error for B = 1. Throws std::runtime_error if Gappa proves none, does not run or
  /// does not understand the script.
  double error(const Problem& problem, const Arithmetic& arithmetic);

  /// An upper bound of the magnitudes of all results of operations on the way, for B = 1, likewise.
  double largest_result(const Problem& problem, const Arithmetic& arithmetic);

  /// Whether Gappa proves that the error is at most `bound` for B = 1.
  bool proves(const Problem& problem, const Arithmetic& arithmetic, double bound);

  /// The last script of `proves`.
  std::string script(const Problem& problem, const Arithmetic& arithmetic, double bound);

  /// Gappa's answer to a script.
  GappaAnswer run(const std::string& script);

 private:
  std::mutex mutex_;
  std::map<std::string, GappaAnswer> known_;
};

}  // namespace nearmiss::proofs
