// The names of scalars in the names of subjects, such as p40 in "wang:p40".
#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace nearmiss {

/// A subject's name, divided into the algorithm and the scalar, without a suffix "@B". If the name has no
/// scalar, `scalar` is "", which means double. Options, as in "wang-eps:h=0.001", belong to the algorithm.
struct ScaledName {
  std::string_view algorithm, scalar;
};
constexpr ScaledName split_scalar(std::string_view name) {
  name = name.substr(0, name.rfind('@'));
  const auto colon = name.find(':');
  if (colon == std::string_view::npos || name.find('=') != std::string_view::npos) return {name, ""};
  return {name.substr(0, colon), name.substr(colon + 1)};
}

namespace ladder {
/// The numbers of bits of the narrowest and the widest scalar, p16 and p256.
inline constexpr int fewest_bits = 16, most_bits = 256;
}  // namespace ladder

/// The exponent in ε = 2^exponent, the machine epsilon of the scalar with this name; nothing if the name is
/// unknown.
inline std::optional<int> epsilon_exponent_of(std::string_view scalar) {
  if (scalar.empty() || scalar == "double") return -52;
  if (scalar == "float") return -23;
  if (scalar == "dd") return -102;
  int bits = 0;
  const char* const end = scalar.data() + scalar.size();
  if (scalar.front() != 'p') return std::nullopt;
  const auto [rest, error] = std::from_chars(scalar.data() + 1, end, bits);
  if (error != std::errc() || rest != end || bits < 2 || bits > ladder::most_bits) return std::nullopt;
  return 1 - bits;
}

}  // namespace nearmiss
