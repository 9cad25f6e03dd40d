#include "fuzz/meshes/lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "ccd/query/excerpt.hpp"
#include "corpus/query_text.hpp"

namespace nearmiss {

namespace {

/// Appends the words of a line.
void split(std::string_view line, std::vector<std::string_view>& words) {
  constexpr std::string_view blanks = " \t\r\v\f";
  for (auto begin = line.find_first_not_of(blanks); begin != std::string_view::npos;) {
    const auto end = std::min(line.find_first_of(blanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(blanks, end);
  }
}

}  // namespace

Lines::Lines(std::string_view text, std::string_view name, Comments comments, Continuation continuation)
    : rest_(without_byte_order_mark(text)), name_(name), comments_(comments), continuation_(continuation) {}

bool Lines::next() {
  read_ = 0;
  words_.clear();
  while (words_.empty()) {
    if (rest_.empty()) return false;
    number_ = taken_ + 1;
    while (take_line()) {
    }
  }
  return true;
}

bool Lines::take_line() {
  std::string_view line = rest_.substr(0, rest_.find('\n'));
  rest_.remove_prefix(std::min(line.size() + 1, rest_.size()));
  ++taken_;
  const std::size_t comment = comments_ == Comments::hash ? line.find('#') : std::string_view::npos;
  line = line.substr(0, comment);
  if (line.ends_with('\r')) line.remove_suffix(1);
  const bool goes_on =
      continuation_ == Continuation::backslash && comment == std::string_view::npos && line.ends_with('\\');
  if (goes_on) line.remove_suffix(1);
  split(line, words_);
  return goes_on && !rest_.empty();
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

std::string lower_case(std::string_view word) {
  std::string lower(word);
  std::transform(word.begin(), word.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

std::string shown(std::string_view word) {
  return word.empty() ? "the end of the file" : fmt::format("'{}'", excerpt(word));
}

}  // namespace nearmiss
