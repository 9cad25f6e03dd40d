// A lock on a file between processes.
#pragma once

#include <filesystem>

namespace nearmiss {

/// A lock held by the process that writes a file. Meanwhile FILE.lock exists next to it; links to the file lead to the
/// same lock. The system releases the lock however the process ends.
class FileLock {
 public:
  /// Throws Error if another process holds the lock, if it cannot be made, or if the file has another name (a hard link),
  /// which could be locked apart.
  explicit FileLock(const std::filesystem::path& file);
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

 private:
  std::filesystem::path lock_;
  int descriptor_ = -1;
};

}  // namespace nearmiss
