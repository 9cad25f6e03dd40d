// Parses values of options as people write them. Errors name the value and its option.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

namespace nearmiss {

/// Parses a whole number from `least` to `most`, such as 100000 or 1e5. Throws Error that names the option.
std::uint64_t parse_count(std::string_view text, std::string_view option, std::uint64_t least,
                          std::uint64_t most);

/// Parses "500ms", "30s", "2m", "8h". Throws Error that names the option.
std::chrono::duration<double> parse_duration(std::string_view text, std::string_view option);

/// Parses a number of bytes: "0", "512M", "1G", "1GiB"; units are powers of 1024. Throws Error that names the
/// option.
std::uint64_t parse_size(std::string_view text, std::string_view option);

/// Parses a positive number. Throws Error that names the option.
double parse_positive(std::string_view text, std::string_view option);

}  // namespace nearmiss
