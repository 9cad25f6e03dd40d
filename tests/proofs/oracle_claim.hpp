// A rounding constant, its proof, and the largest error that was seen.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fuzz/random.hpp"
#include "tests/proofs/witness.hpp"

namespace nearmiss::proofs {

/// One row of the table of bounds. Numbers are in units of `unit`.
struct OracleClaim {
  std::string name;  ///< name of the constant in `file`, followed by a comma and the quantity if there are
                     ///< several
  std::string file;
  std::string unit;
  double claimed;
  std::string method;  ///< "Gappa", or the argument that replaces it
  /// The least value that is proven to be enough, at most `claimed`.
  std::function<double()> proven;
  /// The exact error at given inputs, rounded to double. This error is at most the proven value.
  std::function<double(const Inputs&)> seen;
  /// Inputs with which a search for a witness begins.
  std::function<Inputs(Random&)> draw;

  /// The constant's identifier.
  [[nodiscard]] std::string constant() const { return name.substr(0, name.find(',')); }
};

/// The claims about the constants of oracle/. No constant could be halved.
std::vector<OracleClaim> oracle_claims();

}  // namespace nearmiss::proofs
