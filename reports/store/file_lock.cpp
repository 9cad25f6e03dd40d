#include "reports/store/file_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "ccd/query/error.hpp"
#include "corpus/file.hpp"

namespace nearmiss {

FileLock::FileLock(const std::filesystem::path& file) : lock_(true_path(file).string() + ".lock") {
  std::error_code ignored;
  if (const auto names = std::filesystem::hard_link_count(file, ignored); !ignored && names > 1)
    throw Error(
        fmt::format("{}: found a file with {} names (hard links), expected one", file.string(), names));
  while (true) {
    descriptor_ = open(lock_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
    if (descriptor_ < 0)
      throw Error(fmt::format("{}: cannot be made: {}", lock_.string(), std::strerror(errno)));
    struct stat held {};
    if (fstat(descriptor_, &held) != 0 || !S_ISREG(held.st_mode)) {
      close(descriptor_);
      throw Error(fmt::format("{}: found no regular file, expected one or none", lock_.string()));
    }
    const bool locked = flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
    const bool is_in_place = locked && fstat(descriptor_, &held) == 0 && held.st_nlink > 0;
    if (is_in_place && held.st_size == 0) return;
    close(descriptor_);
    if (is_in_place)
      throw Error(
          fmt::format("{}: found a file with {} bytes, expected none: the lock of {} would replace it",
                      lock_.string(), held.st_size, file.string()));
    if (!locked) throw Error(fmt::format("{}: another process is writing it", file.string()));
    // The process that held the lock has removed the lock file. Try again with a new lock file.
  }
}

FileLock::~FileLock() {
  unlink(lock_.c_str());
  close(descriptor_);
}

}  // namespace nearmiss
