// Makes text from outside safe to show on terminals, in files and on pages.
#pragma once

#include <string>
#include <string_view>

namespace nearmiss {

/// The text as valid UTF-8 without control characters, and without characters that are not seen: each such
/// character, and each byte that is not part of a valid sequence, becomes '?', and each line end a blank.
std::string printable(std::string_view text);

}  // namespace nearmiss
