// A rounding constant, what proves it, and how near to it an error was seen.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "fuzz/random.hpp"

namespace nearmiss::proofs {

/// The inputs of a witness by name.
using Inputs = std::map<std::string, double>;

/// One row of the table of bounds. Numbers are in units of `unit`.
struct Claim {
  std::string name;  ///< the constant's, in `file`; with more behind it where it is claimed of several things
  std::string file;
  std::string unit;
  double claimed;
  std::string method;  ///< "Gappa", or the argument that stands in for it
  /// The least that is proven to be enough, at most `claimed`.
  std::function<double()> proven;
  /// The error that inputs show, exactly, rounded to double; at most what is proven.
  std::function<double(const Inputs&)> seen;
  /// Inputs with which a search for a witness begins.
  std::function<Inputs(Random&)> draw;
};

/// The constants of oracle/: of each, half is not enough.
std::vector<Claim> oracle_claims();

}  // namespace nearmiss::proofs
