// The table of claims about rounding errors.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "tests/proofs/gappa.hpp"

namespace nearmiss::proofs {

/// One bound that the code or the paper relies on.
struct CcdClaim {
  std::string_view name;      ///< unique
  std::string_view constant;  ///< identifier and file
  double claimed;
  double proven;  ///< what Gappa proves for every precision; not above `claimed`
  std::string_view unit;
  std::string_view how;  ///< what of it is proven by Gappa
  std::function<Problem()> problem;
  /// How far products may be off by underflow, for B = 1: a power of two.
  int underflow = underflow_of_vectors;
  bool vectors_alone = false;  ///< of `Arithmetic`

  /// The frame has B in [2^-100, 2^100], or B = 0, so that products, which are of a degree of at most 4 in B,
  /// underflow by at most 2^-1075 (half the smallest double), and by 2^(400 - 1075) where B is scaled to 1.
  static constexpr int underflow_of_vectors = -675;
  /// The same for v·v, if ‖v‖∞ is scaled to 1 and was above 2^-400 B. Below that any time will do: the squared
  /// distance changes by less than 2^-390 B².
  static constexpr int underflow_of_time = -1075 + 1000;
};

/// The precisions, in bits, that every claim is proven for.
inline constexpr int precisions[] = {11, 24, 53, 64, 113, 256};

/// All claims about ccd/, by file.
std::vector<CcdClaim> ccd_claims();

}  // namespace nearmiss::proofs
