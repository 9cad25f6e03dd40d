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

/// The length of the string at the beginning of a line. The string ends with its closing quote, or else with
/// the line.
std::size_t string_length(std::string_view line) {
  const char quote = line.front();
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] == quote) return i + 1;
    if (line[i] == '\\' && quote == '"') ++i;
  }
  return line.size();
}

/// The length of the first piece of a line. A piece is a string, a separator of one character, or a word.
std::size_t piece_length(std::string_view line) {
  constexpr std::string_view separators = " \t\r=,[]\"'#";
  if (line.front() == '"' || line.front() == '\'') return string_length(line);
  return std::clamp<std::size_t>(line.find_first_of(separators), 1, line.size());
}

/// The word, without the underscores between its digits if it is a number.
std::string without_underscores(std::string_view word) {
  constexpr std::string_view digits = "0123456789";
  if (word.find_first_not_of("0123456789_+-.eE") != std::string_view::npos) return std::string(word);
  const auto is_digit = [&](std::size_t i) { return i < word.size() && digits.find(word[i]) != digits.npos; };
  std::string number;
  for (std::size_t i = 0; i < word.size(); ++i)
    if (word[i] != '_' || i == 0 || !is_digit(i - 1) || !is_digit(i + 1)) number += word[i];
  return number;
}

/// Translates TOML, line by line, into the part of TOML that CLI11 reads correctly: each list is on one line,
/// without blanks around its commas and brackets, and without a comma after its last element. The translation
/// has no comments, no underscores in numbers, and no byte order mark.
class SimpleToml {
 public:
  void add(std::string_view line, long number) {
    if (open_.empty()) note_option(line, number);
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

  /// The translation. If a bracket is never closed, throws Error with the line of the bracket.
  [[nodiscard]] std::string finish() && {
    if (!open_.empty())
      throw Error(fmt::format("--config:{}: found '[' without ']', expected both", open_.back()));
    return std::move(text_);
  }

  /// Maps the name of each option that the file sets to the number of the line that sets it. Includes names
  /// that no option has.
  [[nodiscard]] const std::map<std::string, long>& lines() const { return lines_; }

 private:
  void note_option(std::string_view line, long number) {
    const std::string_view before = line.substr(0, line.find_first_of("=#"));
    const std::size_t first = before.find_first_not_of(blanks);
    if (first == before.npos || before[first] == '[') return;
    std::string name(before.substr(first, before.find_last_not_of(blanks) + 1 - first));
    std::erase_if(name, [](char c) { return c == '"' || c == '\''; });
    lines_.emplace(name.substr(name.rfind('.') + 1), number);
  }

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
  std::map<std::string, long> lines_;
};

}  // namespace

ConfigurationFile::ConfigurationFile(std::string command) : command_(std::move(command)) {
  comment('\0');  // SimpleToml has removed the comments; a '#' that is left belongs to a string
}

std::vector<CLI::ConfigItem> ConfigurationFile::from_config(std::istream& input) const {
  SimpleToml text;
  LineReader lines(input, "--config");
  while (lines.next()) text.add(lines.text(), lines.number());
  lines_ = text.lines();
  std::istringstream simple(std::move(text).finish());
  std::vector<CLI::ConfigItem> read = CLI::ConfigTOML::from_config(simple);
  for (CLI::ConfigItem& item : read)
    if (item.parents.empty()) item.parents = {command_};
  return read;
}

}  // namespace nearmiss::tools
