// A program's description of itself.
#pragma once

#include <string>

#include "ccd/nearmiss_subject.h"

namespace nearmiss::isolation {

/// The content of the first lines of a program's output (fuzz/subjects/PROGRAMS.md).
struct ProgramDescription {
  std::string name, version, about;
  bool claims_bound = false;
  bool says_seconds = false;  ///< each answer ends with the seconds that it took, without copies to a device
  bool ignores_separation_in_bounds = false;  ///< in version 2, questions about bounds have h = 0
  /// The other facts about the program; the texts and functions of `subject` are not set.
  nearmiss_subject subject{};

  /// Parses all lines, including the empty line that ends them. Throws Error if a line is invalid, or a
  /// required line is missing.
  static ProgramDescription parse(const std::string& text);
};

}  // namespace nearmiss::isolation
