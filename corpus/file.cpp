#include "corpus/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "ccd/error.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

Error cannot_be_written(const fs::path& file, const std::string& why = "") {
  return Error(fmt::format("{}: cannot be written{}{}", file.string(), why.empty() ? "" : ": ", why));
}

bool write(const fs::path& file, std::string_view text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  return static_cast<bool>(out);
}

/// Makes a file with a name that nothing else has.
fs::path new_file_beside(const fs::path& place) {
  for (int number = 0;; ++number) {
    const std::string name =
        fmt::format("{}.part{}", place.string(), number == 0 ? "" : std::to_string(number));
    const int descriptor = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) {
      close(descriptor);
      return name;
    }
    if (errno != EEXIST) throw cannot_be_written(place, std::strerror(errno));
  }
}

}  // namespace

PartFile::PartFile(fs::path place) : place_(std::move(place)), path_(new_file_beside(place_)) {}

PartFile::~PartFile() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove(path_, ignored);
}

void PartFile::put_in_place() {
  std::error_code error;
  fs::rename(path_, place_, error);
  if (error) throw cannot_be_written(place_, error.message());
  path_.clear();
}

void replace_file(const fs::path& file, std::string_view text) {
  std::error_code error;
  const auto status = fs::symlink_status(file, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    // A link, pipe or device is written through, never replaced.
    if (!write(file, text)) throw cannot_be_written(file);
    return;
  }
  PartFile part(file);
  if (!write(part.path(), text)) throw cannot_be_written(file);
  part.put_in_place();
}

fs::path true_path(const fs::path& path) { return fs::weakly_canonical(fs::absolute(path)); }

void expect_regular_file(const fs::path& file) {
  std::error_code error;
  if (const auto status = fs::status(file, error); fs::exists(status) && !fs::is_regular_file(status))
    throw Error(fmt::format("{}: found {}, expected a file", file.string(),
                            fs::is_directory(status) ? "a folder" : "a pipe or a device"));
}

}  // namespace nearmiss
