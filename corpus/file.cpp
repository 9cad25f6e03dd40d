#include "corpus/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <utility>

#include "ccd/query/error.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

Error cannot_be_written(const fs::path& file, const std::string& why) {
  return Error(fmt::format("{}: cannot be written: {}", file.string(), why));
}

/// Writes the text to a file, and returns whether the whole text was written. After a failure, errno says
/// why.
bool write(const fs::path& file, std::string_view text) {
  errno = 0;
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  return static_cast<bool>(out);
}

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

/// The path of a PartFile, in a form that a signal handler can read: a handler may use only lock-free
/// objects, and must not allocate memory.
struct KnownPart {
  enum State : std::uint8_t { unused, changing, used };
  std::atomic<State> state = unused;
  std::array<char, 4096> path{};
};
static_assert(std::atomic<KnownPart::State>::is_always_lock_free);

std::array<KnownPart, 16>& known_parts() {
  static constinit std::array<KnownPart, 16> parts;
  return parts;
}

/// Notes the path of a PartFile, so that a signal handler can remove the file. If the path is too long, or if
/// too many other paths are noted, the path is not noted, and the handler leaves the file behind.
void remember(const fs::path& path) {
  const std::string& text = path.native();
  for (KnownPart& part : known_parts()) {
    auto expected = KnownPart::unused;
    if (text.size() >= part.path.size() || !part.state.compare_exchange_strong(expected, KnownPart::changing))
      continue;
    *std::ranges::copy(text, part.path.begin()).out = '\0';
    part.state = KnownPart::used;
    return;
  }
}

void forget(const fs::path& path) {
  for (KnownPart& part : known_parts())
    if (part.state == KnownPart::used && path == part.path.data()) part.state = KnownPart::unused;
}

}  // namespace

PartFile::PartFile(fs::path place) : place_(std::move(place)), path_(new_file_beside(place_)) {
  remember(path_);
}

PartFile::~PartFile() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove(path_, ignored);
  forget(path_);
}

void PartFile::write_out() const {
  const int descriptor = open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  posix_fadvise(descriptor, 0, 0, POSIX_FADV_DONTNEED);
  close(descriptor);
}

void PartFile::put_in_place() {
  std::error_code error;
  fs::rename(path_, place_, error);
  if (error) throw cannot_be_written(place_, error.message());
  forget(path_);
  path_.clear();
}

void remove_part_files() noexcept {
  for (const KnownPart& part : known_parts())
    if (part.state == KnownPart::used) unlink(part.path.data());
}

namespace {

/// Whether a path leads, directly or through links, to a file that a process has open, as /dev/stdout does.
bool is_open_file(fs::path path) {
  constexpr int most_links = 40;
  std::error_code none;
  for (int i = 0; i < most_links; ++i) {
    path = fs::absolute(path).lexically_normal();
    if (path.string().starts_with("/proc/") || path.string().starts_with("/dev/")) return true;
    const fs::path target = fs::read_symlink(path, none);
    if (none) return false;
    path = path.parent_path() / target;
  }
  return false;
}

/// Whether a path leads to a pipe, a device or an open file, which cannot be replaced.
bool is_written_through(const fs::path& file) {
  std::error_code error;
  const auto status = fs::status(file, error);
  if (fs::is_directory(status))
    throw Error(fmt::format("{}: found a folder, expected a file", file.string()));
  return fs::exists(status) && (!fs::is_regular_file(status) || is_open_file(file));
}

fs::path target_of(const fs::path& file) { return fs::is_symlink(file) ? true_path(file) : file; }

}  // namespace

void replace_file(const fs::path& file, std::string_view text) {
  if (is_written_through(file)) {
    if (!write(file, text)) throw cannot_be_written(file, std::strerror(errno));
    return;
  }
  PartFile part(target_of(file));
  if (!write(part.path(), text)) throw cannot_be_written(file, std::strerror(errno));
  part.put_in_place();
}

void expect_replaceable(const fs::path& file) {
  if (!is_written_through(file)) const PartFile part(target_of(file));
}

fs::path true_path(const fs::path& path) { return fs::weakly_canonical(fs::absolute(path)); }

void expect_regular_file(const fs::path& file) {
  std::error_code error;
  if (const auto status = fs::status(file, error); fs::exists(status) && !fs::is_regular_file(status))
    throw Error(fmt::format("{}: found {}, expected a file", file.string(),
                            fs::is_directory(status) ? "a folder" : "a pipe or a device"));
}

std::string read_all(std::istream& in, std::string_view name) {
  std::string text;
  constexpr std::streamsize step = 1 << 16;
  do {
    const std::size_t size = text.size();
    text.resize(size + step);
    in.read(text.data() + size, step);
    text.resize(size + static_cast<std::size_t>(in.gcount()));
  } while (in);
  if (in.bad()) throw Error(fmt::format("{}: cannot be read to its end", name));
  return text;
}

std::string read_whole_file(const fs::path& file) {
  constexpr std::uintmax_t most_bytes = 1 << 30;  // a sparse file may have any size
  expect_regular_file(file);
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(fmt::format("{}: cannot be read", file.string()));
  if (const std::uintmax_t bytes = fs::file_size(file); bytes > most_bytes)
    throw Error(fmt::format("{}: found {} bytes, expected at most {}", file.string(), bytes, most_bytes));
  return read_all(in, file.string());
}

}  // namespace nearmiss
