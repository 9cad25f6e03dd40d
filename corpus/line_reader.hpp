// Text, line by line, in bounded memory.
#pragma once

#include <cstddef>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace nearmiss {

/// The longest line that is read, in bytes. A device or a sparse file can have a line without an end.
inline constexpr std::size_t most_line_bytes = 1 << 20;

/// Goes through the lines of a stream, which must outlive this object.
class LineReader {
 public:
  /// Messages call the stream `name`.
  LineReader(std::istream& in, std::string_view name);

  /// Goes on to the next line. Returns false at the end of the stream, or if it cannot be read further. Throws
  /// Error if the line is longer than `most_line_bytes`.
  bool next();

  /// This line, without its '\n'. In the first line, a byte order mark is skipped. Valid until `next`.
  [[nodiscard]] std::string_view text() const { return text_; }

  /// The number of this line, from 1.
  [[nodiscard]] long number() const { return number_; }

  /// "NAME:LINE", for messages.
  [[nodiscard]] std::string where() const;

 private:
  std::istream& in_;
  std::string name_;
  std::vector<char> buffer_;
  std::string_view text_;
  long number_ = 0;
};

}  // namespace nearmiss
