// Parses values of options as people write them. Error messages name the value and its option.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

namespace nearmiss {

/// Parses a whole number, such as 100000 or 1e5. Throws Error unless the text is a whole number from `least`
/// to `most`.
std::uint64_t parse_count(std::string_view text, std::string_view option, std::uint64_t least,
                          std::uint64_t most);

/// Parses a duration: "500ms", "30s", "2m" or "8h". Throws Error for any other form.
std::chrono::duration<double> parse_duration(std::string_view text, std::string_view option);

/// Parses a number of bytes: "0", "512M", "1G" or "1GiB"; units are powers of 1024. Throws Error for any
/// other form.
std::uint64_t parse_size(std::string_view text, std::string_view option);

/// Parses a positive number. Throws Error for any other text.
double parse_positive(std::string_view text, std::string_view option);

}  // namespace nearmiss
