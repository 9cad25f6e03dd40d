// The audit of the paper's rounding constants, read from the file that another command writes.
#pragma once

#include <filesystem>
#include <string>

namespace nearmiss {

/// Reads the JSON that nearmiss audit --json writes. Throws Error if the file is something else.
std::string load_audit(const std::filesystem::path& file);

}  // namespace nearmiss
