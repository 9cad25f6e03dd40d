// Shortens words of the input for messages.
#pragma once

#include <string>
#include <string_view>

namespace nearmiss {

/// A word of the input as messages show it. A word of more than `most` bytes is cut between two UTF-8
/// sequences, and "..." is appended.
inline std::string excerpt(std::string_view word, std::size_t most = 40) {
  if (word.size() <= most) return std::string(word);
  std::size_t end = most;
  while (end > most - 4 && (static_cast<unsigned char>(word[end]) & 0xc0U) == 0x80U) --end;
  return std::string(word.substr(0, end)) + "...";
}

}  // namespace nearmiss
