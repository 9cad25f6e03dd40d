// The table of claims about rounding errors, and its check.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/random.hpp"
#include "tests/proofs/gappa.hpp"
#include "tests/proofs/witness.hpp"

namespace nearmiss::proofs {

/// One bound on which the code or the paper relies.
struct CcdClaim {
  std::string_view name;      ///< unique
  std::string_view constant;  ///< identifier and file
  double claimed;
  double proven;  ///< the bound that Gappa proves for every precision; it is at most `claimed`
  std::string_view unit;
  std::string_view how;  ///< how the claim is proven, and which part of it by Gappa
  std::function<Problem()> problem;
  /// The largest error of a product by underflow is 2^underflow, for B = 1.
  int underflow = underflow_of_vectors;
  bool vectors_alone = false;  ///< as in `Arithmetic`: only the vectors are rounded

  /// `underflow` for products of vectors. In the frame (motion.hpp), B is in [2^-100, 2^100] or 0, and these
  /// products have degree at most 4 in B. Their error by underflow is at most 2^-1075 (half the smallest
  /// double), so at most 2^(400 - 1075) if B is scaled to 1.
  static constexpr int underflow_of_vectors = -675;
  /// `underflow` for v·v, if ‖v‖∞ is scaled to 1 and was above 2^-400 B before. If ‖v‖∞ was at most 2^-400 B,
  /// any time is good enough, because the squared distance changes by less than 2^-390 B².
  static constexpr int underflow_of_time = -1075 + 1000;
};

/// The precisions, in bits, for which every claim about ccd/ is proven, in addition to double.
inline constexpr int precisions[] = {11, 256};

std::vector<CcdClaim> ccd_claims();

/// A constant of oracle/ on which the filter relies. Numbers are in units of `unit`.
struct OracleClaim {
  std::string name;  ///< name of the constant in `file`, followed by a comma and the quantity if the constant
                     ///< has several claims
  std::string file;
  std::string unit;
  double claimed;
  std::string method;  ///< "Gappa", or the argument that replaces a proof by Gappa
  /// The least value of the constant that is proven to be enough; at most `claimed`.
  std::function<double()> proven;
  /// The exact error at given inputs, rounded to double. This error is at most the proven value.
  std::function<double(const Inputs&)> seen;
  /// Draws inputs with which a search for a witness begins.
  std::function<Inputs(Random&)> draw;

  /// The constant's identifier.
  [[nodiscard]] std::string constant() const { return name.substr(0, name.find(',')); }
};

std::vector<OracleClaim> oracle_claims();

/// Describes the faults of a claim. A claim has no faults if all of the following hold. Gappa proves the
/// bound `proven` in every precision; in double, it proves the bound with underflow. The bound that Gappa
/// proves in double is not far below `proven`, and not below the witness's error. No result overflows. seen
/// <= proven <= claimed. The witness has exactly the recorded error.
std::vector<std::string> faults(const CcdClaim& claim, const Witness& witness, Prover& prover);

/// The faults of all claims, each checked with its witness. Uses two threads.
std::vector<std::string> faults(const std::vector<CcdClaim>& claims, const Witnesses& witnesses);

/// Describes the faults of a claim about oracle/. A claim has no faults if seen <= proven <= claimed, and the
/// witness has exactly the recorded error.
std::vector<std::string> faults(const OracleClaim& claim, const Witness& witness);

/// The table with the claimed, the proven and the seen value of each constant, in the constant's unit.
std::string table_of_bounds(const Witnesses& witnesses);

}  // namespace nearmiss::proofs
