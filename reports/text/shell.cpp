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
  while (!text.empty()) {
    const bool is_escaped = text.starts_with("\\'");
    const bool has_escapes = text.starts_with("$'");
    if (!is_escaped && !has_escapes && text[0] != '\'' && text[0] != ' ' && plain.find(text[0]) == plain.npos)
      return false;
    std::size_t length = is_escaped || has_escapes ? 2 : 1;
    if (has_escapes || text[0] == '\'') {
      for (char before = '\0';
           length < text.size() && (text[length] != '\'' || (has_escapes && before == '\\'));)
        before = before == '\\' ? '\0' : text[length], ++length;
      if (length++ >= text.size()) return false;  // the quote does not end
    }
    text.remove_prefix(length);
  }
  return true;
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
