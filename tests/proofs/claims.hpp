// The table of claims about rounding errors.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "tests/proofs/gappa.hpp"

namespace nearmiss::proofs {

/// One bound on which the code or the paper relies.
struct CcdClaim {
  std::string_view name;      ///< unique
  std::string_view constant;  ///< identifier and file
  double claimed;
  double proven;  ///< bound that Gappa proves for every precision, at most `claimed`
  std::string_view unit;
  std::string_view how;  ///< how the claim is proven, and which part of it by Gappa
  std::function<Problem()> problem;
  /// The largest error of a product by underflow is 2^underflow, for B = 1.
  int underflow = underflow_of_vectors;
  bool vectors_alone = false;  ///< as in `Arithmetic`: only the vectors are rounded

  /// In the frame, B is in [2^-100, 2^100] or 0, and products have degree at most 4 in B. Their error by
  /// underflow is at most 2^-1075 (half the smallest double), and 2^(400 - 1075) if B is scaled to 1.
  static constexpr int underflow_of_vectors = -675;
  /// The exponent for v·v, if ‖v‖∞ is scaled to 1 and was above 2^-400 B. If it was below, any time will do,
  /// because the squared distance changes by less than 2^-390 B².
  static constexpr int underflow_of_time = -1075 + 1000;
};

/// The precisions, in bits, for which every claim is proven.
inline constexpr int precisions[] = {11, 24, 53, 64, 113, 256};

/// All claims about ccd/, in the order of its files.
std::vector<CcdClaim> ccd_claims();

}  // namespace nearmiss::proofs
