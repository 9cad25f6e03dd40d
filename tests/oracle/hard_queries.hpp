// Queries that are difficult for rounding.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "ccd/query/query.hpp"
#include "fuzz/random.hpp"

namespace nearmiss::testing {

/// Makes numbers and queries that are difficult for rounding: with very different magnitudes, with
/// cancellation, with few bits or with all bits. All numbers and queries depend only on the seed and the
/// index of the case.
class Hard : public Random {
 public:
  Hard(std::uint64_t seed, std::size_t index) : Random(seed, 0, index) {}

  /// A number between -2^e and 2^e, where the exponent e is drawn between `lowest` and `highest`.
  double small(int lowest, int highest) {
    const double mantissa = uniform(-1, 1);
    return std::ldexp(mantissa, integer(lowest, highest));
  }

  double number() {
    switch (integer(0, 3)) {
      case 0:
        return integer(-4, 4);
      case 1:
        return uniform(-1, 1);
      case 2:
        return small(-60, 0);
      default:
        return 1 + small(-52, -20);
    }
  }

  Query query() {
    Query query{.kind = kinds[static_cast<std::size_t>(integer(0, 1))]};
    const double flat = integer(0, 3) == 0 ? std::ldexp(1.0, integer(-80, 0)) : 1;
    for (std::size_t i = 0; i < 24; ++i) query.x[i] = number() * (i % 3 == 2 ? flat : 1);
    if (integer(0, 3) == 0) {  // nearly at rest
      for (std::size_t i = 0; i < 12; ++i) query.x[12 + i] = query.x[i] + small(-50, -1);
    }
    if (integer(0, 7) == 0) {
      const double scale = std::ldexp(1.0, integer(-1000, 300));
      for (double& c : query.x) c *= scale;
    }
    return query;
  }
};

}  // namespace nearmiss::testing
