// The file of a plug-in: identifies its bytes, and checks that they stay the same.
#pragma once

#include <sys/stat.h>

#include <functional>
#include <mutex>
#include <string>
#include <string_view>

#include "ccd/query/error.hpp"
#include "fuzz/stop.hpp"

namespace nearmiss::isolation {

/// The file of a plug-in was changed while its answers were collected.
class PluginChanged : public Error {
 public:
  using Error::Error;
};

/// The file of a plug-in, as it was when this object was made. Libraries that the plug-in loads are not
/// included. Many threads use it at once.
class PluginFile {
 public:
  /// Reads the file. Throws Error if that fails.
  explicit PluginFile(std::string path);

  [[nodiscard]] const std::string& path() const { return path_; }
  /// The SHA-256 digest of its bytes, in hexadecimal.
  [[nodiscard]] const std::string& sha256() const { return sha256_; }
  /// Its GNU build id, in hexadecimal; "" if it has none.
  [[nodiscard]] const std::string& build_id() const { return build_id_; }

  /// Throws PluginChanged unless the path still leads to a file with the same bytes. The file is read again
  /// only if its times, its size or its inode have changed; otherwise this takes about a microsecond. Throws
  /// Stopped if `stop` is due meanwhile.
  void expect_unchanged(const Stop& stop) const;

 private:
  /// The attributes that change when a file is written or replaced.
  struct Stamp {
    dev_t device{};
    ino_t inode{};
    off_t size{};
    timespec written{}, changed{};

    bool operator==(const Stamp& other) const;
  };
  struct Snapshot;

  static Stamp stamp_of(const struct stat& about);
  /// Reads the whole file, and passes its bytes to `take`, piece by piece.
  [[nodiscard]] Snapshot read(const std::function<void(std::string_view)>& take) const;
  /// Whether the file could be written again without a change of its stamp, because the clock of the file
  /// system may not have ticked since.
  static bool is_recent(const Stamp& stamp);

  std::string path_, sha256_, build_id_;
  mutable std::mutex mutex_;
  mutable Stamp stamp_;  ///< when the bytes were last read
  mutable bool is_recent_ = false;
};

/// The GNU build id of an ELF file, in hexadecimal; "" if it has none.
std::string gnu_build_id(std::string_view elf);

}  // namespace nearmiss::isolation
