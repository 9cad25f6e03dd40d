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

/// The arithmetic of a proof. Every operation is rounded to nearest with `bits` bits, so its relative error
/// is at most u = 2^-bits.
struct Arithmetic {
  int bits = 53;
  /// If set, each product and quotient has an additional error of up to 2^underflow, for B = 1.
  std::optional<int> underflow{};
  /// If true, the relative vectors are rounded when they are formed, and all computations with the rounded
  /// vectors are exact.
  bool vectors_alone = false;
};

/// What Gappa has proven about a problem, for B = 1.
struct ProvenBounds {
  double error;           ///< bound of the problem's error
  double largest_result;  ///< bound of the magnitudes of all intermediate results
};

/// Runs Gappa on scripts, and keeps Gappa's answers, because several problems may need the same lemma.
/// Several threads may use a Prover at once.
///
/// A problem is proven in steps. First Gappa proves lemmas, which bound the errors of frequent expressions: a
/// velocity, a position at the time, or an expression of maxima, minima and magnitudes. A maximum, minimum or
/// magnitude changes by no more than its operands do, so its error is at most the largest error of its
/// operands. Later scripts have a new variable for each such expression. The last script has all operations
/// that belong to no lemma.
class Prover {
 public:
  /// The bounds that Gappa proves. Throws std::runtime_error if Gappa proves no bounds, does not run, or does
  /// not understand the script.
  ProvenBounds bounds(const Problem& problem, const Arithmetic& arithmetic);

  /// Whether Gappa proves that the error is at most `bound` for B = 1.
  bool proves(const Problem& problem, const Arithmetic& arithmetic, double bound);

  /// The script that `proves` gives to Gappa last, after the scripts of the lemmas.
  std::string script(const Problem& problem, const Arithmetic& arithmetic, double bound);

  GappaAnswer run(const std::string& script);

 private:
  std::mutex mutex_;
  std::map<std::string, GappaAnswer> known_;
};

}  // namespace nearmiss::proofs
