// Commands for a shell.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nearmiss {

/// An argument for a shell, in quotes if it needs them.
std::string shell_quoted(const std::string& argument);

/// The words of a simple command as a shell divides it: at blanks that are not in quotes or behind a
/// backslash, which are removed. Nothing is expanded.
std::vector<std::string> shell_words(std::string_view command);

}  // namespace nearmiss
