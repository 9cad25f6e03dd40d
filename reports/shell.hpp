// Commands that people copy into a shell.
#pragma once

#include <string>

namespace nearmiss {

/// An argument as a shell takes it, in quotes where it needs them.
std::string shell_quoted(const std::string& argument);

}  // namespace nearmiss
