// Parses values of options as people write them. Errors name the value and its option.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace nearmiss::tools {

/// The largest number of queries that an option takes.
inline constexpr std::uint64_t most_queries = std::uint64_t{1} << 62;

/// Parses a whole number from `least` to `most`, such as 100000 or 1e5. Throws Error that names the option.
std::uint64_t parse_count(std::string_view text, std::string_view option, std::uint64_t least,
                          std::uint64_t most);

/// Parses "500ms", "30s", "2m", "8h". Throws Error that names the option.
std::chrono::duration<double> parse_duration(std::string_view text, std::string_view option);

/// Parses a number of bytes: "0", "512M", "1G", "1GiB"; units are powers of 1024. Throws Error that names the
/// option.
std::uint64_t parse_size(std::string_view text, std::string_view option);

/// Adds an option whose value is a whole number from `least` to `most`. --help shows the present value as the
/// default. `value` must live as long as the command.
template <class Integer>
CLI::Option* add_count_option(CLI::App& command, const std::string& name, Integer& value, std::uint64_t least,
                              std::uint64_t most, const std::string& description) {
  return command
      .add_option_function<std::string>(
          name,
          [&value, name, least, most](const std::string& text) {
            value = static_cast<Integer>(parse_count(text, name, least, most));
          },
          description)
      ->default_str(std::to_string(value))
      ->type_name("N");
}

}  // namespace nearmiss::tools
