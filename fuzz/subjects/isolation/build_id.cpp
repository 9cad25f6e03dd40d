#include <link.h>

#include <cstring>

#include "fuzz/subjects/isolation/plugin_file.hpp"
#include "reports/sha256.hpp"

namespace nearmiss::isolation {

namespace {

/// The bytes [offset, offset + size); fewer at the end of the file.
std::string_view part(std::string_view bytes, std::size_t offset, std::size_t size) {
  return offset > bytes.size() ? std::string_view() : bytes.substr(offset, size);
}

/// A structure at an offset; zeros if the file ends before the structure does.
template <class Structure>
Structure at(std::string_view bytes, std::size_t offset) {
  Structure structure{};
  const std::string_view found = part(bytes, offset, sizeof structure);
  if (found.size() == sizeof structure) std::memcpy(&structure, found.data(), sizeof structure);
  return structure;
}

/// The build id among the notes of a segment.
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

}  // namespace nearmiss::isolation
