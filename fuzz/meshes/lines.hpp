// Text formats, line by line and word by word.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "ccd/error.hpp"

namespace nearmiss {

/// Everything that a stream holds. Throws Error if it cannot be read to its end.
std::string read_all(std::istream& in, std::string_view name);

/// Goes through the lines of a text that hold a word, and splits each into words at blanks. The text must outlive this.
class Lines {
 public:
  enum class Comments { none, hash };  ///< hash: from '#' to the end of the line

  Lines(std::string_view text, std::string_view name, Comments comments);

  /// Goes on to the next line; false at the end of the text.
  bool next();

  /// The words of this line, at least one.
  [[nodiscard]] const std::vector<std::string_view>& words() const { return words_; }

  /// The next word of this line, or of a later one; empty at the end of the text.
  std::string_view next_word();

  /// Makes next_word go on after this line.
  void skip_line() { read_ = words_.size(); }

  /// The text after this line.
  [[nodiscard]] std::string_view rest() const { return rest_; }

  /// The number of this line, from 1.
  [[nodiscard]] long number() const { return number_; }

  /// "NAME:LINE", for messages.
  [[nodiscard]] std::string where() const { return where(number_); }
  [[nodiscard]] std::string where(long line) const;

  /// The error of finding this at this line.
  [[nodiscard]] Error error(std::string_view found, std::string_view expected) const;

 private:
  std::string_view rest_;
  std::string name_;
  Comments comments_;
  long number_ = 0;
  std::vector<std::string_view> words_;
  std::size_t read_ = 0;  ///< number of words that next_word has returned
};

/// The finite decimal number that a word is. Throws Error if it is none.
double parse_decimal(std::string_view word, const Lines& lines);

/// A word, or the lack of one, as messages show it.
std::string shown(std::string_view word);

}  // namespace nearmiss
