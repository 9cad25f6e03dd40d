// Writing a file whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace nearmiss {

/// Replaces the file by this text: a reader, or a full disk, never leaves half of it behind. What is no plain
/// file (/dev/stdout, a link) is written through. Throws Error.
void replace_file(const std::filesystem::path& file, std::string_view text);

}  // namespace nearmiss
