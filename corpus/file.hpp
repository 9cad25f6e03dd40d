// Writes a file whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace nearmiss {

/// Replaces the file's content by this text. No reader ever sees half of it, and a full disk leaves the old
/// file unchanged. A link or a device (/dev/stdout) is written through. Throws Error.
void replace_file(const std::filesystem::path& file, std::string_view text);

}  // namespace nearmiss
