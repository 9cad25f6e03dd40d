// The unit in which the distances of false positives are given.
#pragma once

#include <cstdint>
#include <string_view>

namespace nearmiss {

/// Distances are given as fractions of the bound that the subject claims. If it claims none, they are
/// fractions of wang's bound for the same pair, which is a unit of length and no claim.
enum class DistanceUnit : std::uint8_t {
  claimed_bound,
  wangs_bound,
  both,  ///< runs with different versions of a subject were added up
};

/// As files name it.
constexpr std::string_view name(DistanceUnit unit) {
  switch (unit) {
    case DistanceUnit::claimed_bound:
      return "claimed";
    case DistanceUnit::wangs_bound:
      return "wang";
    default:
      return "claimed or wang";
  }
}

}  // namespace nearmiss
