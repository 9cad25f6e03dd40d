// What /proc says about a process.
#pragma once

#include <sys/types.h>

#include <cstdio>
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

}  // namespace nearmiss::isolation
