// JSON that a command keeps and another reads.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace nearmiss {

/// Passes on what a file has. Throws Error that names the file, what was found and `expected` where it cannot be
/// read or `take` throws nlohmann's exception: what is there is not what it looks for.
void read_json_file(const std::filesystem::path& file, std::string_view expected,
                    const std::function<void(const nlohmann::ordered_json&)>& take);

}  // namespace nearmiss
