// Confidence bounds of rates.
#pragma once

#include <cstdint>

namespace nearmiss {

/// The one-sided 95 % upper confidence bound of a rate of which `count` in `total` were seen (Clopper and
/// Pearson 1934): the rate at which seeing no more than `count` has probability 5 %. 1 where nothing was
/// looked at.
double clopper_pearson_upper(std::uint64_t count, std::uint64_t total);

}  // namespace nearmiss
