// Runs Gappa as a process.
#pragma once

#include <string>

namespace nearmiss::proofs {

/// Gappa's output for a script, and whether Gappa proves all goals of the script.
struct GappaAnswer {
  std::string text;
  bool proven;
};

/// Runs a script. Throws std::runtime_error if Gappa does not run, does not understand the script, or gives a
/// warning, for instance of a hint that it takes on trust.
GappaAnswer run_gappa(const std::string& script, const std::string& options = "");

/// The upper end of the interval that Gappa proves for the only goal of a script, "... in ?", rounded upward.
/// Gappa computes this end with 400 bits, a precision that is finer than the errors of double words.
double proven_upper_end(const std::string& script);

/// Whether Gappa proves all goals of a script. Throws the same exceptions as run_gappa.
bool is_proven(const std::string& script);

}  // namespace nearmiss::proofs
