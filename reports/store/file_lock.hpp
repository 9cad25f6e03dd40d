// A lock that lets only one process at a time write a file.
#pragma once

#include <filesystem>

namespace nearmiss {

/// A lock held by the process that writes a file. While the process holds the lock, FILE.lock exists next to
/// the file. A symbolic link to the file leads to the same lock. The system releases the lock however the
/// process ends.
class FileLock {
 public:
  /// Takes the lock. Throws Error if another process holds it, if it cannot be made, or if the file has a
  /// second name (a hard link): another process could lock the file separately under that name.
  explicit FileLock(const std::filesystem::path& file);
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

 private:
  std::filesystem::path lock_;
  int descriptor_ = -1;
};

}  // namespace nearmiss
