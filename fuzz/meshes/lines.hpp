// Reads a text line by line and word by word.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "ccd/query/error.hpp"

namespace nearmiss {

/// Goes through a text line by line, skips lines without a word, and splits the other lines into words at
/// blanks. A byte order mark at the beginning is skipped. The text must outlive this object.
class Lines {
 public:
  enum class Comments { none, hash };  ///< hash: a comment goes from '#' to the end of the line
  /// backslash: a line that ends in '\' continues in the next line, unless the '\' is in a comment.
  enum class Continuation { none, backslash };

  Lines(std::string_view text, std::string_view name, Comments comments,
        Continuation continuation = Continuation::none);

  /// Goes on to the next line. Returns false at the end of the text.
  bool next();

  /// The words of this line. There is at least one.
  [[nodiscard]] const std::vector<std::string_view>& words() const { return words_; }

  /// The next word of this line. After the last word of this line, the first word of the next line; at the
  /// end of the text, an empty word.
  std::string_view next_word();

  /// Makes next_word() continue with the next line.
  void skip_line() { read_ = words_.size(); }

  /// The text after this line.
  [[nodiscard]] std::string_view rest() const { return rest_; }

  /// The number of this line in the text, counted from 1. If this line continues in the next lines of the
  /// text, this is the number of the first of these lines.
  [[nodiscard]] long number() const { return number_; }

  /// "NAME:LINE", for messages.
  [[nodiscard]] std::string where() const { return where(number_); }
  [[nodiscard]] std::string where(long line) const;

  /// An error that reports what was found and expected at this line.
  [[nodiscard]] Error error(std::string_view found, std::string_view expected) const;

 private:
  /// Adds the words of the next line of the text to this line. Returns whether this line continues in another
  /// line of the text.
  bool take_line();

  std::string_view rest_;
  std::string name_;
  Comments comments_;
  Continuation continuation_;
  long number_ = 0;
  long taken_ = 0;  ///< number of lines of the text before rest_
  std::vector<std::string_view> words_;
  std::size_t read_ = 0;  ///< number of words that next_word has returned
};

/// Throws Error if the word is not a finite decimal number.
double parse_decimal(std::string_view word, const Lines& lines);

std::string lower_case(std::string_view word);

/// The word in the form in which messages show it. For an empty word, the result is "the end of the file".
std::string shown(std::string_view word);

}  // namespace nearmiss
