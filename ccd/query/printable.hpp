// Makes text from outside safe to show on terminals, in files and on pages.
#pragma once

#include <string>
#include <string_view>

namespace nearmiss {

/// The text as valid UTF-8 without control characters: each byte or character that is neither printable nor
/// part of a valid sequence becomes '?', and each line end becomes a blank.
std::string printable(std::string_view text);

/// Whether a text consists of valid UTF-8 without control characters, except line ends and tabs.
bool has_printable_lines(std::string text);

}  // namespace nearmiss
