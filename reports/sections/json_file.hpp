// JSON files that one command writes and another reads.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace nearmiss {

/// Reads a file and passes its content to `take`. Throws Error if the file cannot be read, if it is not JSON,
/// or if `take` throws an exception of the JSON library; the message contains `expected`.
void read_json_file(const std::filesystem::path& file, std::string_view expected,
                    const std::function<void(const nlohmann::ordered_json&)>& take);

}  // namespace nearmiss
