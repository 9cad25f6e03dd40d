// The unit in which the distances of false positives are given.
#pragma once

#include <cstdint>
#include <string_view>

namespace nearmiss {

/// The bound by which distances are divided: the bound that the subject claims. If it claims none, wang's
/// bound for the same pair, which then is only a unit of length.
enum class DistanceUnit : std::uint8_t {
  claimed_bound,
  wangs_bound,
  both,  ///< runs with different versions of a subject were added up
};

/// The name of a unit in files.
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
