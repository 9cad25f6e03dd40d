// Files that are built or installed with this program.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace nearmiss {

/// The path of a file or folder that belongs to nearmiss. The file or folder is in this program's folder, in
/// NEARMISS_INSTALLED if nearmiss is installed, or in NEARMISS_BUILT if this program is in a build folder.
/// fuzz/CMakeLists.txt sets the last two paths, relative to the program's folder.
inline std::string path_beside(std::string_view name) {
  std::error_code unknown;
  const auto here = std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
  for (const char* const folder : {"", NEARMISS_INSTALLED, NEARMISS_BUILT}) {
    const auto path = (here / folder / name).lexically_normal();
    if (std::filesystem::exists(path, unknown)) return path.string();
  }
  return (here / name).string();
}

}  // namespace nearmiss
