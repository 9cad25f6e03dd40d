// Identifies the code of a plug-in by its bytes, and checks that these bytes stay the same.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/stop.hpp"
#include "fuzz/subjects/isolation/plugin_file.hpp"

namespace nearmiss::isolation {

/// The files that a command names. The program's file comes first. A command may begin with "cd FOLDER &&
/// exec".
std::vector<std::string> files_of_program(std::string_view command);

/// The files of a plug-in, as they were when this object was made: the shared object, or all files that a
/// command names, including the program. Files that the shared object or the named files load are not
/// included. Many threads may use a PluginCode at once.
class PluginCode {
 public:
  /// Reads the files. Throws Error if a file cannot be read.
  explicit PluginCode(std::string name);

  /// The plug-in's name on the command line.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// The SHA-256 digest of a shared object, in hexadecimal. For a command, the digest of its files' digests.
  [[nodiscard]] const std::string& sha256() const { return sha256_; }
  /// The GNU build id of a shared object, in hexadecimal; "" if the shared object has no build id.
  [[nodiscard]] const std::string& build_id() const { return build_id_; }

  void expect_unchanged(const Stop& stop) const;

 private:
  std::string name_, sha256_, build_id_;
  std::vector<std::unique_ptr<PluginFile>> files_;
};

}  // namespace nearmiss::isolation
