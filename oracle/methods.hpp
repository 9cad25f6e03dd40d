// The exact methods that decide a query: one table, which the comparison of their answers, the command line and
// README.md read or repeat. README.md says how to add one.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include "ccd/query.hpp"

namespace nearmiss {

/// A method's answer to a query; a member without a value is unknown to it.
struct Answer {
  std::optional<bool> collision{};    ///< whether the primitives meet
  std::optional<bool> on_boundary{};  ///< whether they do at an end of the step or at a border of a primitive
  std::optional<bool> odd{};  ///< whether the number of roots is odd, with multiplicity; not on the boundary
  std::size_t detail = 0;  ///< what else it saw, a number below 32: a query with a new one is new to a fuzzer
};

/// The promise of a method.
enum class Claim {
  complete,  ///< it always knows whether there is a collision
  parity,    ///< it knows one on the boundary, or by an odd number of roots
};

/// "complete" or "parity".
std::string_view name(Claim claim);

/// A method that decides every finite query exactly, as far as it claims to.
struct Method {
  std::string_view name;
  std::string_view about;  ///< how it decides, in a line
  Claim claim;
  std::function<Answer(const Query&)> ask;
};

/// All of them; they share no code. The first one is complete, and the one that decides what the filter cannot.
std::span<const Method> methods();

}  // namespace nearmiss
