// Reads text line by line, in bounded memory.
#pragma once

#include <cstddef>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace nearmiss {

/// The largest length of a line, in bytes. LineReader refuses longer lines, because a device may send a line
/// without an end, and a sparse file may have a line of any length.
inline constexpr std::size_t most_line_bytes = 1 << 20;

/// Goes through the lines of a stream, which must outlive this object.
class LineReader {
 public:
  /// Error messages call the stream `name`.
  LineReader(std::istream& in, std::string_view name);

  /// Reads the next line. Returns false if there is no further line, or if the stream cannot be read further.
  /// Throws Error if the line is longer than `most_line_bytes`.
  bool next();

  /// The current line, without its '\n'. In the first line, a byte order mark is skipped. The text is valid
  /// until next() is called.
  [[nodiscard]] std::string_view text() const { return text_; }

  /// The number of the current line, from 1.
  [[nodiscard]] long number() const { return number_; }

  /// "NAME:LINE" of the current line, for messages.
  [[nodiscard]] std::string where() const;

 private:
  std::istream& in_;
  std::string name_;
  std::vector<char> buffer_;
  std::string_view text_;
  long number_ = 0;
};

}  // namespace nearmiss
