// Identifies a file of a plug-in by its bytes, and checks that these bytes stay the same.
#pragma once

#include <sys/stat.h>

#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

#include "fuzz/stop.hpp"
#include "fuzz/subjects/isolation/trial_error.hpp"

namespace nearmiss::isolation {

/// Thrown if a plug-in's file was changed while the plug-in's answers were collected.
class PluginChanged : public TrialError {
 public:
  using TrialError::TrialError;
};

/// A file of a plug-in, as it was when this object was made. Libraries that the plug-in loads are not
/// included. Many threads may use a PluginFile at once.
class PluginFile {
 public:
  /// Reads the file. Throws Error if it cannot be read.
  explicit PluginFile(std::string path);

  [[nodiscard]] const std::string& path() const { return path_; }
  /// The SHA-256 digest of the file's bytes, in hexadecimal.
  [[nodiscard]] const std::string& sha256() const { return sha256_; }
  /// The file's GNU build id, in hexadecimal; "" if the file has no build id.
  [[nodiscard]] const std::string& build_id() const { return build_id_; }

  /// Throws PluginChanged unless the path still leads to a file with the same bytes. Reads the file again
  /// only if the file's stamp (device, inode, size, times) has changed, or if the stamp was so recent at the
  /// last reading that a later change of the file might not change the stamp. Otherwise, the check takes
  /// about a microsecond. Throws Stopped if `stop` is due during a reading.
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
  /// The state of the file when its bytes were read.
  struct Snapshot {
    /// The stamp of the file, taken before the file was read.
    Stamp stamp;
    std::chrono::steady_clock::time_point first_seen;  ///< when this stamp was seen for the first time
    /// Whether the file could be written again without a change of its stamp, because the file system's clock
    /// may not have ticked since the times in the stamp.
    bool is_recent;
  };

  static Stamp stamp_of(const struct stat& about);
  /// Reads the whole file, and passes its bytes to `take`, piece by piece.
  [[nodiscard]] Snapshot read(const std::function<void(std::string_view)>& take) const;
  [[nodiscard]] Snapshot snapshot_of(const Stamp& stamp) const;

  std::string path_, sha256_, build_id_;
  mutable std::mutex mutex_;
  mutable Snapshot last_{};  ///< the state of the file at the last reading
};

/// The GNU build id of an ELF file, in hexadecimal; "" if the file has no build id.
std::string gnu_build_id(std::string_view elf);

}  // namespace nearmiss::isolation
