// Commands that people copy into a shell.
#pragma once

#include <string>

namespace nearmiss {

/// An argument for a shell, in quotes if it needs them.
std::string shell_quoted(const std::string& argument);

}  // namespace nearmiss
