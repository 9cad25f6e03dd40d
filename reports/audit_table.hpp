// The audit of the paper's rounding constants, which a report only shows.
#pragma once

#include <filesystem>
#include <string>

namespace nearmiss {

/// Reads the file that nearmiss audit keeps, as JSON. Throws Error where it is something else.
std::string load_audit(const std::filesystem::path& file);

}  // namespace nearmiss
