// Options whose values are numbers.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "reports/text/values.hpp"

namespace nearmiss::tools {

/// The largest number of queries that an option takes.
inline constexpr std::uint64_t most_queries = std::uint64_t{1} << 62;

/// Adds an option whose value is a whole number from `least` to `most`. --help shows the present content of
/// `value` as the default. `value` must live as long as the command.
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
