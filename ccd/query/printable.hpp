// Makes text that others wrote safe to show on a terminal, in a file and on a web page.
#pragma once

#include <string>
#include <string_view>

namespace nearmiss {

/// The text as valid UTF-8 of visible characters. A line end or a tab becomes a blank. Any other control
/// character, a character that is not seen, and a byte that is not part of a valid sequence become '?'.
std::string printable(std::string_view text);

}  // namespace nearmiss
