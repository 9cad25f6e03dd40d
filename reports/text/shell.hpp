// Quotes and splits commands for a shell.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nearmiss {

/// An argument for a shell, in quotes if it needs them.
std::string shell_quoted(const std::string& argument);

/// An argument for bash, ksh or zsh, in printable text: bytes that are not printable are octal escapes, as in
/// $'M\344.case'.
std::string printable_argument(const std::string& argument);

/// Whether a text is one command, and nothing else that a shell would run. The arguments must be quoted as
/// the functions above quote them.
bool is_one_command(std::string_view text);

/// The words into which a shell divides a simple command. A blank divides words unless it is in quotes or
/// follows a backslash. Removes quotes and backslashes, and expands nothing.
std::vector<std::string> shell_words(std::string_view command);

}  // namespace nearmiss
