// Confidence bounds of rates.
#pragma once

#include <cstdint>

namespace nearmiss {

/// The one-sided 95 % upper confidence bound of a rate of which `count` in `total` were seen (Clopper and
/// Pearson 1934): the rate at which seeing no more than `count` has probability 5 %. 1 where nothing was
/// looked at.
double clopper_pearson_upper(std::uint64_t count, std::uint64_t total);

/// What a rate may be, in [0, 1].
struct Interval {
  double lo = 0, hi = 1;

  bool operator==(const Interval&) const = default;
};

/// The two-sided interval of Clopper and Pearson: the true rate is below it with probability `risk` / 2 at
/// most, and above it likewise. [0, 1] where nothing was looked at.
Interval clopper_pearson(std::uint64_t count, std::uint64_t total, double risk = 0.05);

}  // namespace nearmiss
