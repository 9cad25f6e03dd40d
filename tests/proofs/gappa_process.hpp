// Gappa as a process: scripts in, proofs out.
#pragma once

#include <string>

namespace nearmiss::proofs {

/// Whether Gappa proves all goals of a script. Throws std::runtime_error where it does not run or cannot read
/// the script.
bool is_proven(const std::string& script);

/// The upper end of the interval that Gappa proves for the only goal of a script, "... in ?", rounded upward.
double proven_upper_end(const std::string& script);

}  // namespace nearmiss::proofs
