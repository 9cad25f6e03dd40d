#include "tools/new_file.hpp"

#include <fmt/format.h>

#include "ccd/query/error.hpp"

namespace nearmiss::tools {

void expect_new(const std::filesystem::path& file) {
  if (std::filesystem::exists(file))
    throw Error(fmt::format("{}: exists already, expected a new file", file.string()));
}

NewFile::NewFile(const std::filesystem::path& place)
    : place_((expect_new(place), place)), part_(place), out_(part_.path()) {}

void NewFile::write(const std::string& text) {
  constexpr std::size_t much = 64 << 20;
  out_ << text;
  size_ += text.size();
  if (size_ - written_out_ < much) return;
  out_.flush();
  part_.write_out();
  written_out_ = size_;
}

void NewFile::close() {
  out_.close();
  if (!out_) throw Error(fmt::format("{}: cannot be written", place_.string()));
}

void NewFile::put_in_place() {
  if (size_ > 0) part_.put_in_place();
}

}  // namespace nearmiss::tools
