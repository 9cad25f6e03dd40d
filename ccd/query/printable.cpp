#include "ccd/query/printable.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace nearmiss {

namespace {

/// The length of the UTF-8 sequence at the start of a text; 0 if the sequence is not valid (RFC 3629), or its
/// character is not printable.
std::size_t printable_sequence(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  if (byte(0) < 0x80) return byte(0) >= 0x20 && byte(0) != 0x7f ? 1 : 0;
  const std::size_t length = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < length) return 0;
  constexpr std::array<unsigned, 5> lead_bits{0, 0, 0x1f, 0x0f, 0x07};
  std::uint32_t code = byte(0) & lead_bits[length];
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3f);
  }
  constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
  const bool is_control = code < 0xa0;
  // Characters that a reader does not see. These characters end a line, change the direction of other text,
  // or make two different texts look alike.
  using Range = std::pair<std::uint32_t, std::uint32_t>;
  constexpr std::array<Range, 23> unseen{
      {{0xad, 0xad},       {0x34f, 0x34f},     {0x61c, 0x61c},    {0x115f, 0x1160}, {0x180b, 0x180f},
       {0x17b4, 0x17b5},   {0x200b, 0x200b},   {0x200e, 0x200f},  {0x2028, 0x202e}, {0x2060, 0x206f},
       {0x2800, 0x2800},   {0x3164, 0x3164},   {0xe000, 0xf8ff},  {0xfdd0, 0xfdef}, {0xfe00, 0xfe0f},
       {0xfeff, 0xfeff},   {0xffa0, 0xffa0},   {0xfff0, 0xfffb},  {0xfffe, 0xffff}, {0x13430, 0x1343f},
       {0x1bca0, 0x1bca3}, {0x1d173, 0x1d17a}, {0xe0000, 0xe0fff}}};
  const bool is_unseen = std::any_of(unseen.begin(), unseen.end(), [&](const Range& range) {
    return range.first <= code && code <= range.second;
  });
  const bool is_fine =
      code >= least[length] && code <= 0x10ffff && !is_surrogate && !is_control && !is_unseen;
  return is_fine ? length : 0;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = printable_sequence(text);
    if (length != 0)
      result += text.substr(0, length);
    else
      result += text[0] == '\n' || text[0] == '\t' ? ' ' : '?';
    text.remove_prefix(length != 0 ? length : 1);
  }
  return result;
}

}  // namespace nearmiss
