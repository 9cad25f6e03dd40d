// Text from elsewhere, made fit for terminals, files and pages.
#pragma once

#include <string>
#include <string_view>

namespace nearmiss {

/// The text as valid UTF-8 without control characters: each byte or character that is neither printable nor
/// part of a valid sequence becomes '?', and a line end a blank.
std::string printable(std::string_view text);

}  // namespace nearmiss
