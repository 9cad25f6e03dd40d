// A lock on a file between processes.
#pragma once

#include <filesystem>

namespace nearmiss {

/// A lock held by the process that writes a file. While it is held, FILE.lock exists next to the file. A
/// symbolic link to the file leads to the same lock. The system releases the lock however the process ends.
class FileLock {
 public:
  /// Throws Error if another process holds the lock, if the lock cannot be made, or if the file has a second
  /// name (a hard link), under which another process could lock it separately.
  explicit FileLock(const std::filesystem::path& file);
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

 private:
  std::filesystem::path lock_;
  int descriptor_ = -1;
};

}  // namespace nearmiss
