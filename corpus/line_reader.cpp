#include "corpus/line_reader.hpp"

#include <fmt/format.h>

#include "ccd/query/error.hpp"
#include "corpus/query_text.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t buffer_bytes = most_line_bytes + 1;  // getline ends a line with '\0'

}  // namespace

LineReader::LineReader(std::istream& in, std::string_view name)
    : in_(in), name_(name), buffer_(buffer_bytes) {}

bool LineReader::next() {
  in_.getline(buffer_.data(), buffer_bytes);
  const auto taken = static_cast<std::size_t>(in_.gcount());
  if (in_.bad() || taken == 0) return false;
  ++number_;
  if (in_.fail())
    throw Error(fmt::format("{}: found a line of more than {} bytes, expected a shorter one", where(),
                            most_line_bytes));
  text_ = {buffer_.data(), in_.eof() ? taken : taken - 1};  // gcount() counts the '\n', too
  if (number_ == 1) text_ = without_byte_order_mark(text_);
  return true;
}

std::string LineReader::where() const { return fmt::format("{}:{}", name_, number_); }

}  // namespace nearmiss
