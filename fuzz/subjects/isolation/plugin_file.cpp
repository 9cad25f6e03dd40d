#include "fuzz/subjects/isolation/plugin_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <link.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>

#include "fuzz/subjects/isolation/handles.hpp"
#include "reports/sha256.hpp"

namespace nearmiss::isolation {

namespace {

/// The largest size of a plug-in. The usual relocations of x86-64 and AArch64 code cannot address more bytes.
constexpr off_t most_bytes = off_t{1} << 31;

bool is_same(const timespec& a, const timespec& b) { return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec; }

/// The bytes [offset, offset + size), or fewer if the file ends earlier.
std::string_view part(std::string_view bytes, std::size_t offset, std::size_t size) {
  return offset > bytes.size() ? std::string_view() : bytes.substr(offset, size);
}

/// The structure at an offset; all zeros if the file ends within the structure.
template <class Structure>
Structure at(std::string_view bytes, std::size_t offset) {
  Structure structure{};
  const std::string_view found = part(bytes, offset, sizeof structure);
  if (found.size() == sizeof structure) std::memcpy(&structure, found.data(), sizeof structure);
  return structure;
}

/// The build id among the notes of a segment; "" if the notes contain no build id.
std::string build_id_in(std::string_view notes) {
  const auto aligned = [](std::size_t size) { return (size + 3) / 4 * 4; };
  while (notes.size() >= sizeof(ElfW(Nhdr))) {
    const auto note = at<ElfW(Nhdr)>(notes, 0);
    const std::size_t start = sizeof note + aligned(note.n_namesz);
    if (note.n_type == NT_GNU_BUILD_ID &&
        part(notes, sizeof note, note.n_namesz) == std::string_view("GNU\0", 4))
      return hex(part(notes, start, note.n_descsz));
    notes = part(notes, start + aligned(note.n_descsz), notes.size());
  }
  return "";
}

}  // namespace

std::string gnu_build_id(std::string_view elf) {
  const auto header = at<ElfW(Ehdr)>(elf, 0);
  if (std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) return "";
  for (std::size_t i = 0; i < header.e_phnum; ++i) {
    const auto segment = at<ElfW(Phdr)>(elf, header.e_phoff + i * sizeof(ElfW(Phdr)));
    if (segment.p_type != PT_NOTE) continue;
    if (std::string id = build_id_in(part(elf, segment.p_offset, segment.p_filesz)); !id.empty()) return id;
  }
  return "";
}

bool PluginFile::Stamp::operator==(const Stamp& other) const {
  return device == other.device && inode == other.inode && size == other.size &&
         is_same(written, other.written) && is_same(changed, other.changed);
}

PluginFile::Stamp PluginFile::stamp_of(const struct stat& about) {
  return {about.st_dev, about.st_ino, about.st_size, about.st_mtim, about.st_ctim};
}

PluginFile::PluginFile(std::string path) : path_(std::move(path)) {
  std::string bytes;
  last_ = read([&](std::string_view piece) { bytes += piece; });
  sha256_ = sha256_hex(bytes);
  build_id_ = gnu_build_id(bytes);
}

PluginFile::Snapshot PluginFile::snapshot_of(const Stamp& stamp) const {
  constexpr std::chrono::seconds coarsest_tick(2);  // on FAT
  const auto now = std::chrono::steady_clock::now();
  const auto first_seen = stamp == last_.stamp ? last_.first_seen : now;
  // The stamp counts as recent only while both comparisons hold. If the file system's clock is ahead of ours,
  // the first comparison holds for too long, but the second comparison holds only for two seconds after the
  // stamp was first seen.
  const bool is_recent =
      std::time(nullptr) <= stamp.changed.tv_sec + coarsest_tick.count() && now <= first_seen + coarsest_tick;
  return {stamp, first_seen, is_recent};
}

PluginFile::Snapshot PluginFile::read(const std::function<void(std::string_view)>& take) const {
  const auto refuse = [&](const std::string& why) {
    throw Error(fmt::format("{}: cannot load the plug-in: {}", path_, why));
  };
  const Descriptor file(open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat about {};
  if (file.number() < 0 || fstat(file.number(), &about) != 0) refuse(std::strerror(errno));
  if (!S_ISREG(about.st_mode)) refuse("found no regular file");
  if (about.st_size > most_bytes)
    refuse(fmt::format("found {} bytes, expected a shared object of at most 2 GiB", about.st_size));
  const Snapshot reading = snapshot_of(stamp_of(about));
  std::array<char, 1 << 16> block{};
  while (true) {
    const ssize_t size = ::read(file.number(), block.data(), block.size());
    if (size < 0) refuse(std::strerror(errno));
    if (size == 0) return reading;
    take({block.data(), static_cast<std::size_t>(size)});
  }
}

void PluginFile::expect_unchanged(const Stop& stop) const {
  const std::lock_guard lock(mutex_);
  struct stat about {};
  const bool exists = stat(path_.c_str(), &about) == 0;
  if (exists && stamp_of(about) == last_.stamp && !last_.is_recent) return;
  const auto refuse = [&](const std::string& found) {
    throw PluginChanged(
        fmt::format("{}: the plug-in was changed while it was on trial: found {}, expected the file with "
                    "sha256 {}",
                    path_, found, sha256_));
  };
  if (!exists) refuse("no such file");
  Sha256 bytes;
  const Snapshot reading = read([&](std::string_view piece) {
    stop.check(Stop::grace);
    bytes.add(piece);
  });
  if (const std::string found = bytes.hex_digest(); found != sha256_) refuse("sha256 " + found);
  last_ = reading;
}

}  // namespace nearmiss::isolation
