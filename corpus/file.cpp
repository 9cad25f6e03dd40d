#include "corpus/file.hpp"

#include <fmt/format.h>

#include <fstream>

#include "ccd/error.hpp"

namespace nearmiss {

namespace {

bool write(const std::filesystem::path& file, std::string_view text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  return static_cast<bool>(out);
}

}  // namespace

void replace_file(const std::filesystem::path& file, std::string_view text) {
  std::error_code error;
  bool written = false;
  const auto status = std::filesystem::symlink_status(file, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    written = write(file, text);  // a link, pipe or device is written through, never replaced
  } else {
    const std::filesystem::path part = file.string() + ".part";
    written = write(part, text);
    if (written) std::filesystem::rename(part, file, error);
    written = written && !error;
    std::error_code ignored;
    if (!written) std::filesystem::remove(part, ignored);
  }
  if (!written) throw Error(fmt::format("{}: cannot be written", file.string()));
}

}  // namespace nearmiss
