// The one exception type of the project.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace nearmiss {

/// An error that the user can correct: bad usage or bad input. The message is one line that says where the
/// error is (file and line, if any), what was found and what was expected. Only tools/ prints it.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A word of the input as messages show it: one of more than `most` bytes is cut, at a border of UTF-8 sequences, and ends
/// in "...".
inline std::string excerpt(std::string_view word, std::size_t most = 40) {
  if (word.size() <= most) return std::string(word);
  std::size_t end = most;
  while (end > most - 4 && (static_cast<unsigned char>(word[end]) & 0xc0U) == 0x80U) --end;
  return std::string(word.substr(0, end)) + "...";
}

}  // namespace nearmiss
