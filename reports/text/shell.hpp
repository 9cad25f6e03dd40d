// Commands for a shell.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nearmiss {

/// An argument for a shell, in quotes if it needs them.
std::string shell_quoted(const std::string& argument);

/// An argument for bash, ksh or zsh, as printable text. If it has bytes that are not printable, they are
/// escaped in octal, as in $'M\344.case'.
std::string printable_argument(const std::string& argument);

/// Whether a text is one command whose arguments are quoted as above, so that a shell does nothing else.
bool is_one_command(std::string_view text);

/// The words into which a shell divides a simple command. Blanks divide words unless they are in quotes or
/// follow a backslash. Quotes and backslashes are removed. Nothing is expanded.
std::vector<std::string> shell_words(std::string_view command);

}  // namespace nearmiss
