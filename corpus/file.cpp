#include "corpus/file.hpp"

#include <fmt/format.h>

#include <fstream>

#include "ccd/error.hpp"

namespace nearmiss {

void replace_file(const std::filesystem::path& file, std::string_view text) {
  const std::filesystem::path part = file.string() + ".part";
  std::ofstream out(part, std::ios::binary);
  out << text;
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(part, file, error);
  if (!out || error) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw Error(fmt::format("{}: cannot be written", file.string()));
  }
}

}  // namespace nearmiss
