#include "reports/text/shell.hpp"

#include <fmt/format.h>

#include "ccd/query/printable.hpp"

namespace nearmiss {

namespace {

constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_@%+=:,./-";

}  // namespace

std::string shell_quoted(const std::string& argument) {
  if (!argument.empty() && argument.find_first_not_of(plain) == std::string::npos) return argument;
  std::string quoted = "'";
  for (const char c : argument) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string printable_argument(const std::string& argument) {
  if (printable(argument) == argument) return shell_quoted(argument);
  std::string quoted = "$'";
  for (const char c : argument) {
    const bool is_plain = c >= ' ' && c <= '~' && c != '\'' && c != '\\';
    quoted += is_plain ? std::string(1, c) : fmt::format("\\{:03o}", static_cast<unsigned char>(c));
  }
  return quoted + "'";
}

bool is_one_command(std::string_view text) {
  const auto is_octal = [](std::string_view digits) {
    return digits.size() == 3 && digits.find_first_not_of("01234567") == digits.npos;
  };
  bool in_quotes = false;
  bool has_escapes = false;  // in $'...'
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\'') {
      in_quotes = !in_quotes;
      has_escapes = in_quotes && i > 0 && text[i - 1] == '$';
    } else if (c == '\\' && has_escapes) {
      if (!is_octal(text.substr(i + 1, 3))) return false;
    } else if (in_quotes) {
      continue;
    } else if (text.substr(i, 2) == "\\'") {
      ++i;
    } else if (text.substr(i, 2) != "$'" && c != ' ' && plain.find(c) == plain.npos) {
      return false;
    }
  }
  return !in_quotes;
}

std::vector<std::string> shell_words(std::string_view command) {
  constexpr std::string_view blanks = " \t\n";
  constexpr std::string_view escaped_in_quotes = "$`\"\\\n";
  std::vector<std::string> words;
  bool in_word = false;
  char quote = '\0';
  for (std::size_t i = 0; i < command.size(); ++i) {
    const char c = command[i];
    const bool is_blank = quote == '\0' && blanks.find(c) != std::string_view::npos;
    if (!is_blank && !in_word) words.emplace_back();
    in_word = !is_blank;
    if (is_blank) continue;
    const bool has_next = i + 1 < command.size();
    const bool escapes = c == '\\' && quote != '\'' && has_next &&
                         (quote == '\0' || escaped_in_quotes.find(command[i + 1]) != std::string_view::npos);
    if (escapes) {
      words.back() += command[++i];
    } else if (c == quote) {
      quote = '\0';
    } else if (quote == '\0' && (c == '\'' || c == '"')) {
      quote = c;
    } else {
      words.back() += c;
    }
  }
  return words;
}

}  // namespace nearmiss
