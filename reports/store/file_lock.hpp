// A lock on a file between processes.
#pragma once

#include <filesystem>

namespace nearmiss {

/// A lock held by the process that writes a file. Meanwhile FILE.lock exists next to it. The system releases
/// the lock however the process ends.
class FileLock {
 public:
  /// Throws Error if another process holds the lock, or if it cannot be made.
  explicit FileLock(const std::filesystem::path& file);
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

 private:
  std::filesystem::path lock_;
  int descriptor_ = -1;
};

}  // namespace nearmiss
