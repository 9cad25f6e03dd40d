// Shrinking: the simplest query that still fails in the same way.
#pragma once

#include <functional>
#include <tuple>

#include "ccd/query.hpp"

namespace nearmiss {

/// How much there is to say of a query. What stands first counts for more than all that stands behind it.
struct Complexity {
  int numbers = 0;    ///< coordinates that are not 0; one that rests from t = 0 to t = 1 is one number
  int moving = 0;     ///< coordinates that do not rest
  int distinct = 0;   ///< magnitudes other than 0
  int bits = 0;       ///< significant bits of these, all together
  int exponents = 0;  ///< magnitudes of their exponents, all together
  int negative = 0;   ///< coordinates with a sign

  bool operator==(const Complexity&) const = default;
  bool operator<(const Complexity& other) const {
    const auto key = [](const Complexity& c) {
      return std::tie(c.numbers, c.moving, c.distinct, c.bits, c.exponents, c.negative);
    };
    return key(*this) < key(other);
  }
};

Complexity complexity(const Query& query);

/// The simplest query that a failing one leads to by steps that each make it simpler, where `fails` tells of
/// a query of the same kind whether it still fails: numbers become 0, small, short, or like others; vertices
/// rest or coincide; all is moved, sheared and scaled. Greedy, until no step is left: what has been shrunk
/// stays as it is. A pure function of both, and no more work than for some seconds. What does not fail stays
/// as it is.
Query shrunk(const Query& query, const std::function<bool(const Query&)>& fails);

}  // namespace nearmiss
