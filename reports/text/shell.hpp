// Quotes and splits commands for a shell.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nearmiss {

/// An argument for a shell, in quotes if it needs them.
std::string shell_quoted(const std::string& argument);

/// An argument for bash, ksh or zsh, as printable text. If the argument has bytes that are not printable,
/// they become octal escapes, as in $'M\344.case'.
std::string printable_argument(const std::string& argument);

/// Whether a shell would take a text for one command, and run nothing else. Only arguments that are quoted as
/// the functions above quote them are accepted.
bool is_one_command(std::string_view text);

/// The words into which a shell divides a simple command. A blank ends a word unless the blank is in quotes
/// or follows a backslash. Removes quotes and backslashes. Expands nothing.
std::vector<std::string> shell_words(std::string_view command);

}  // namespace nearmiss
