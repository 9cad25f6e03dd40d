// Gappa as a process: scripts in, proofs out.
#pragma once

#include <string>

namespace nearmiss::proofs {

/// Gappa's output for a script, and whether it proves all of its goals.
struct GappaAnswer {
  std::string text;
  bool proven;
};

/// Throws std::runtime_error if Gappa does not run, does not understand the script, or warns: of a hint that it
/// takes on trust, for instance.
GappaAnswer run_gappa(const std::string& script, const std::string& options = "");

/// The upper end of the interval that Gappa proves for the only goal of a script, "... in ?", rounded upward. Its own
/// interval bounds are finer than the errors of double words.
double proven_upper_end(const std::string& script);

/// Whether it proves all goals, likewise.
bool is_proven(const std::string& script);

}  // namespace nearmiss::proofs
