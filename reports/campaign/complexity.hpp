// Measures how complex a query looks to a reader.
#pragma once

#include <array>
#include <span>
#include <tuple>
#include <vector>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// The complexities of two queries are compared member by member, in the order of declaration.
struct Complexity {
  /// How hard the query is to draw, as a sum over the distinct magnitudes of its numbers. A magnitude adds 0
  /// if it is an integer of one digit, 1 if it is another multiple of 1/4 below 100, and 2 otherwise.
  int awkward = 0;
  /// Number of nonzero coordinates at t = 0 and at t = 1, plus 1 if the query has a separation. A coordinate
  /// that does not move counts once.
  int numbers = 0;
  int moving = 0;     ///< number of coordinates that move
  int distinct = 0;   ///< number of distinct magnitudes other than 0, including the separation
  int bits = 0;       ///< number of significant bits of these magnitudes together
  int exponents = 0;  ///< sum of the absolute values of the exponents of these magnitudes
  int negative = 0;   ///< number of coordinates with a minus sign, -0 included

  bool operator==(const Complexity&) const = default;
  bool operator<(const Complexity& other) const {
    const auto key = [](const Complexity& c) {
      return std::tie(c.awkward, c.numbers, c.moving, c.distinct, c.bits, c.exponents, c.negative);
    };
    return key(*this) < key(other);
  }
};

Complexity complexity(const Query& query);

/// The coordinates of a query, and its separation.
using Numbers = std::array<double, 25>;
Numbers numbers_of(const Query& query);

/// The magnitudes of the nonzero `numbers`, sorted and without repetition.
std::vector<double> magnitudes(std::span<const double> numbers);

/// The number of bits from the first to the last set bit of a magnitude.
int significant_bits(double magnitude);

}  // namespace nearmiss
