// Shrinking: the simplest query that still fails in the same way.
#pragma once

#include <functional>
#include <tuple>

#include "ccd/query.hpp"

namespace nearmiss {

/// The complexity of a query. Two queries are compared by the members in this order.
struct Complexity {
  /// What magnitudes that are hard to draw add up to: nothing for an integer of one digit, 1 for another multiple of 1/4
  /// below 100, and 2 for any other.
  int awkward = 0;
  int numbers = 0;    ///< nonzero coordinates; a coordinate at rest counts once
  int moving = 0;     ///< coordinates that are not at rest
  int distinct = 0;   ///< magnitudes other than 0
  int bits = 0;       ///< sum of the significant bits of these magnitudes
  int exponents = 0;  ///< sum of the absolute values of their exponents
  int negative = 0;   ///< coordinates with a minus sign, -0 included

  bool operator==(const Complexity&) const = default;
  bool operator<(const Complexity& other) const {
    const auto key = [](const Complexity& c) {
      return std::tie(c.awkward, c.numbers, c.moving, c.distinct, c.bits, c.exponents, c.negative);
    };
    return key(*this) < key(other);
  }
};

Complexity complexity(const Query& query);

/// Simplifies a failing query step by step, as long as it still `fails`. All numbers together become small integers;
/// single numbers become 0, small, short or equal to others; vertices come to rest or coincide; the query is moved,
/// sheared and scaled. The search is greedy and ends when no step makes the query simpler, so shrinking the result again changes nothing. This
/// is a pure function of both arguments and takes at most some seconds. A query that does not fail is
/// returned unchanged. To add a step, write a method of Shrinker (shrink.cpp) and call it in run().
Query shrunk(const Query& query, const std::function<bool(const Query&)>& fails);

}  // namespace nearmiss
