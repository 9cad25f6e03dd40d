// The description that a program gives of itself.
#pragma once

#include <string>

#include "ccd/nearmiss_subject.h"

namespace nearmiss::isolation {

/// The lines with which a program begins (fuzz/subjects/PROGRAMS.md).
struct ProgramDescription {
  std::string name, version, about;
  bool claims_bound = false;
  bool says_seconds = false;  ///< each answer ends with the seconds that it took without copies
  bool ignores_separation_in_bounds = false;  ///< version 2: is asked for bounds without the separation
  nearmiss_subject subject{};                 ///< the rest, without texts and functions

  /// Reads all lines, the empty one included. Throws Error.
  static ProgramDescription parse(const std::string& text);
};

}  // namespace nearmiss::isolation
