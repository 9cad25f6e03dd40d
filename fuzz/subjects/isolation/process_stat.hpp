// What /proc says about a process.
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
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
  std::uint64_t data = 0;       ///< what it can write to, and shares with nobody
};

/// The memory of the process with this folder in /proc; nothing if there is no such process.
inline std::optional<Memory> memory_in(const std::string& folder) {
  std::FILE* const file = std::fopen((folder + "/statm").c_str(), "re");
  if (file == nullptr) return std::nullopt;
  unsigned long addresses = 0, data = 0;
  const bool is_read = std::fscanf(file, "%lu %*u %*u %*u %*u %lu", &addresses, &data) == 2;
  std::fclose(file);
  const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return is_read ? std::optional(Memory{addresses * page, data * page}) : std::nullopt;
}

}  // namespace nearmiss::isolation
