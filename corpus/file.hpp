// Reads whole files, writes files whole or not at all, resolves links, and refuses paths that are not regular
// files.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>

namespace nearmiss {

/// A temporary file in the folder of `place`. put_in_place() renames this file to `place`; otherwise, the
/// destructor removes the file.
class PartFile {
 public:
  /// Makes the temporary file, which is empty. Throws Error if the file cannot be made.
  explicit PartFile(std::filesystem::path place);
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;
  ~PartFile();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Asks the system to write the file's content to disk, and to drop the content from memory. Without this
  /// call, removing a file of gigabytes takes seconds.
  void write_out() const;

  /// Renames the file to `place`. Throws Error if the file cannot be renamed.
  void put_in_place();

 private:
  std::filesystem::path place_, path_;
};

/// Removes the files of all PartFile objects. A signal handler that ends the program may call this function.
void remove_part_files() noexcept;

/// Replaces the content of a file, or of the file that a link leads to, with `text`. No reader ever sees a
/// part of the text, and a full disk leaves the old file unchanged. If the file is a pipe or a device
/// (/dev/stdout), the text is written to it directly. Throws Error if the file cannot be written.
void replace_file(const std::filesystem::path& file, std::string_view text);

/// Throws Error if replace_file() would fail because the path leads to a folder, or because no file can be
/// made beside the file to replace. Changes nothing.
void expect_replaceable(const std::filesystem::path& file);

/// The absolute path of a file, in which all links are resolved. The file need not exist.
std::filesystem::path true_path(const std::filesystem::path& path);

/// Throws Error if a path leads to something other than a regular file, such as a pipe or a folder. A path
/// that leads to nothing is accepted.
void expect_regular_file(const std::filesystem::path& file);

/// The whole content of a stream. Throws an Error, which calls the stream `name`, if the stream cannot be
/// read to its end.
std::string read_all(std::istream& in, std::string_view name);

/// The whole content of a regular file. Throws Error if the path leads to something other than a regular
/// file, or if the file cannot be read or has more than 1 GiB.
std::string read_whole_file(const std::filesystem::path& file);

}  // namespace nearmiss
