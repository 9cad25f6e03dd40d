#include "tools/configuration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <istream>
#include <sstream>
#include <string_view>
#include <utility>

#include "ccd/query/error.hpp"
#include "corpus/line_reader.hpp"

namespace nearmiss::tools {

namespace {

constexpr std::string_view blanks = " \t\r";

/// Where the string that begins a line ends: behind its second quote, or at the end of the line.
std::size_t string_length(std::string_view line) {
  const char quote = line.front();
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] == quote) return i + 1;
    if (line[i] == '\\' && quote == '"') ++i;
  }
  return line.size();
}

/// How long the first piece of a line is: a string, a character that separates, or a word.
std::size_t piece_length(std::string_view line) {
  constexpr std::string_view separators = " \t\r=,[]\"'#";
  if (line.front() == '"' || line.front() == '\'') return string_length(line);
  return std::clamp<std::size_t>(line.find_first_of(separators), 1, line.size());
}

/// The word; if it is a number, without underscores between digits.
std::string without_underscores(std::string_view word) {
  constexpr std::string_view digits = "0123456789";
  if (word.find_first_not_of("0123456789_+-.eE") != std::string_view::npos) return std::string(word);
  const auto is_digit = [&](std::size_t i) { return i < word.size() && digits.find(word[i]) != digits.npos; };
  std::string number;
  for (std::size_t i = 0; i < word.size(); ++i)
    if (word[i] != '_' || i == 0 || !is_digit(i - 1) || !is_digit(i + 1)) number += word[i];
  return number;
}

/// Makes the text that simple_toml returns, line by line.
class SimpleToml {
 public:
  void add(std::string_view line, long number) {
    while (!line.empty() && line.front() != '#') {
      const std::size_t length = piece_length(line);
      add_piece(line.substr(0, length), number);
      line.remove_prefix(length);
    }
    if (open_.empty())
      text_ += '\n';
    else
      add_piece(" ", number);
  }

  /// Throws Error.
  [[nodiscard]] std::string finish() && {
    if (!open_.empty()) throw Error(fmt::format("--config:{}: found '[' without ']'", open_.back()));
    return std::move(text_);
  }

 private:
  void add_piece(std::string_view piece, long line) {
    const char first = piece.front();
    const bool is_quoted = first == '"' || first == '\'';
    const bool in_list = !open_.empty();
    if (in_list && (first == ',' || first == ']')) remove_last(blanks);
    if (in_list && first == ']') {
      remove_last(",");
      open_.pop_back();
    }
    if (first == '[') open_.push_back(line);
    const bool at_begin = text_.ends_with('[') || text_.ends_with(',');
    if (in_list && at_begin && blanks.find(first) != std::string_view::npos) return;
    text_ += is_quoted ? std::string(piece) : without_underscores(piece);
  }

  void remove_last(std::string_view characters) { text_.erase(text_.find_last_not_of(characters) + 1); }

  std::string text_;
  std::vector<long> open_;  // the lines of the brackets that are not closed yet
};

}  // namespace

std::string simple_toml(std::istream& input) {
  SimpleToml text;
  LineReader lines(input, "--config");
  while (lines.next()) text.add(lines.text(), lines.number());
  return std::move(text).finish();
}

ConfigurationFile::ConfigurationFile(std::string command) : command_(std::move(command)) {
  comment('\0');  // simple_toml has removed the comments; a '#' that is left belongs to a string
}

std::vector<CLI::ConfigItem> ConfigurationFile::from_config(std::istream& input) const {
  std::istringstream simple(simple_toml(input));
  std::vector<CLI::ConfigItem> read = CLI::ConfigTOML::from_config(simple);
  for (CLI::ConfigItem& item : read)
    if (item.parents.empty()) item.parents = {command_};
  return read;
}

}  // namespace nearmiss::tools
