// One process at a time.
#pragma once

#include <filesystem>

namespace nearmiss {

/// Held while a file is written; the system lets go of it whatever becomes of the process. A file FILE.lock
/// stands beside it meanwhile.
class FileLock {
 public:
  /// Throws Error where another process holds it, or it cannot be made.
  explicit FileLock(const std::filesystem::path& file);
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

 private:
  std::filesystem::path lock_;
  int descriptor_ = -1;
};

}  // namespace nearmiss
