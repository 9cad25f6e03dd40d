// Reads from /proc how much memory a process has.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>

namespace nearmiss::isolation {

/// The memory of a process in bytes.
struct Memory {
  std::uint64_t addresses = 0;  ///< the size of the address space
  std::uint64_t data = 0;       ///< private writable memory, without the stack
};

/// The text of a file about a process in /proc; "" if the process ended before the whole file was read.
inline std::string text_about_process(const std::string& file) {
  std::ifstream in(file);
  std::string text;
  std::getline(in, text, '\0');
  return text;
}

/// The memory of the process with this folder in /proc; nothing if the process does not exist.
inline std::optional<Memory> memory_in(const std::string& folder) {
  const std::string text = text_about_process(folder + "/status");
  if (text.empty()) return std::nullopt;
  const auto bytes = [&](const char* name) -> std::uint64_t {
    constexpr std::uint64_t unit = 1024;
    const std::size_t line = text.find(name);
    return line == std::string::npos ? 0 : unit * std::strtoull(&text[line + std::strlen(name)], nullptr, 10);
  };
  return Memory{bytes("\nVmSize:"), bytes("\nVmData:")};
}

}  // namespace nearmiss::isolation
