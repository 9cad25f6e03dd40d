// Files that are built with this program.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace nearmiss {

/// The path of a file or folder beside this program, or else `built`, the path where it was built.
inline std::string path_beside(std::string_view name, std::string_view built) {
  std::error_code unknown;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const auto beside = self.parent_path() / name;
  return std::filesystem::exists(beside, unknown) ? beside.string() : std::string(built);
}

}  // namespace nearmiss
