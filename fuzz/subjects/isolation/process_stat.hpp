// What /proc says about a process.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>

namespace nearmiss::isolation {

/// The fields of /proc/PID/stat (proc(5)) from the third on, behind the name, which may contain anything; ""
/// if there is no such process.
inline std::string stat_behind_name(pid_t process) {
  std::FILE* const file = std::fopen(("/proc/" + std::to_string(process) + "/stat").c_str(), "re");
  if (file == nullptr) return "";
  constexpr std::size_t most = 1024;
  std::string text(most, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  const std::size_t end_of_name = text.rfind(')');
  return end_of_name == std::string::npos ? "" : text.substr(end_of_name + 1);
}

/// The memory of a process in bytes.
struct Memory {
  std::uint64_t addresses = 0;  ///< its address space
  std::uint64_t data = 0;       ///< what it can write to, and shares with nobody, without its stack
};

/// The memory of the process with this folder in /proc; nothing if there is no such process.
inline std::optional<Memory> memory_in(const std::string& folder) {
  std::FILE* const file = std::fopen((folder + "/status").c_str(), "re");
  if (file == nullptr) return std::nullopt;
  constexpr std::size_t most = 4096;
  std::string text(most, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  const auto bytes = [&](const char* name) -> std::uint64_t {
    constexpr std::uint64_t unit = 1024;
    const std::size_t line = text.find(name);
    return line == std::string::npos ? 0 : unit * std::strtoull(&text[line + std::strlen(name)], nullptr, 10);
  };
  return Memory{bytes("\nVmSize:"), bytes("\nVmData:")};
}

}  // namespace nearmiss::isolation
