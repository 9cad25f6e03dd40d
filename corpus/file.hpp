// Writes a file whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace nearmiss {

/// A new file beside another one, whose place it takes at the end. It is removed if it does not.
class PartFile {
 public:
  /// Makes an empty file. Throws Error.
  explicit PartFile(std::filesystem::path place);
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;
  ~PartFile();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Gives the file its place. Throws Error.
  void put_in_place();

 private:
  std::filesystem::path place_, path_;
};

/// Replaces the file's content by this text. No reader ever sees half of it, and a full disk leaves the old
/// file unchanged. A link or a device (/dev/stdout) is written through. Throws Error.
void replace_file(const std::filesystem::path& file, std::string_view text);

/// Throws Error if a path is something other than a regular file, such as a pipe or a folder. Nothing is said if there
/// is no such file.
void expect_regular_file(const std::filesystem::path& file);

}  // namespace nearmiss
