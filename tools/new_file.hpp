// Files that a command writes under temporary names until they are complete.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "corpus/file.hpp"

namespace nearmiss::tools {

/// Throws Error if the file exists.
void expect_new(const std::filesystem::path& file);

class NewFile {
 public:
  /// Makes the file under a temporary name. Throws Error if `place` exists, or if the file cannot be made.
  explicit NewFile(const std::filesystem::path& place);

  void write(const std::string& text);
  /// Closes the file. Throws Error if any of its content could not be written.
  void close();
  /// Gives the file its final name, unless it is empty. Call close() first.
  void put_in_place();

 private:
  std::filesystem::path place_;
  PartFile part_;
  std::ofstream out_;
  std::size_t size_ = 0, written_out_ = 0;
};

}  // namespace nearmiss::tools
