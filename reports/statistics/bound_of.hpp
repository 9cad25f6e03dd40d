// Whose bound divides the distances of false positives.
#pragma once

#include <cstdint>
#include <string_view>

namespace nearmiss {

/// Distances are given as fractions of the bound that the subject claims. If it claims none, they are fractions of
/// wang's bound for the same pair, which is a unit of length and no claim.
enum class BoundOf : std::uint8_t {
  subject,
  wang,
  both,  ///< runs with different versions of a subject were added up
};

/// As files name it.
constexpr std::string_view name(BoundOf bound_of) {
  switch (bound_of) {
    case BoundOf::subject:
      return "claimed";
    case BoundOf::wang:
      return "wang";
    default:
      return "claimed or wang";
  }
}

}  // namespace nearmiss
