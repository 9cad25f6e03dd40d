#include "fuzz/meshes/lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <istream>

#include "corpus/query_text.hpp"

namespace nearmiss {

namespace {

void split(std::string_view line, std::vector<std::string_view>& words) {
  constexpr std::string_view blanks = " \t\r\v\f";
  words.clear();
  for (auto begin = line.find_first_not_of(blanks); begin != std::string_view::npos;) {
    const auto end = std::min(line.find_first_of(blanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(blanks, end);
  }
}

}  // namespace

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

Lines::Lines(std::string_view text, std::string_view name, Comments comments)
    : rest_(text), name_(name), comments_(comments) {}

bool Lines::next() {
  read_ = 0;
  do {
    if (rest_.empty()) {
      words_.clear();
      return false;
    }
    ++number_;
    std::string_view line = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(std::min(line.size() + 1, rest_.size()));
    if (comments_ == Comments::hash) line = line.substr(0, line.find('#'));
    split(line, words_);
  } while (words_.empty());
  return true;
}

std::string_view Lines::next_word() {
  if (read_ == words_.size() && !next()) return {};
  return words_[read_++];
}

std::string Lines::where(long line) const { return fmt::format("{}:{}", name_, line); }

Error Lines::error(std::string_view found, std::string_view expected) const {
  return Error(fmt::format("{}: found {}, expected {}", where(), found, expected));
}

double parse_decimal(std::string_view word, const Lines& lines) {
  const double value = parse_number(word, lines.where());
  if (word.find_first_of("xX") != std::string_view::npos) throw lines.error(shown(word), "a decimal number");
  return value;
}

std::string shown(std::string_view word) {
  constexpr std::size_t most = 40;  // because a binary file may have long words
  if (word.empty()) return "the end of the file";
  if (word.size() > most) return fmt::format("'{}...'", word.substr(0, most));
  return fmt::format("'{}'", word);
}

}  // namespace nearmiss
