// Sums of a campaign's counters.
#pragma once

#include <functional>
#include <map>
#include <type_traits>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// Adds up all counters for which `key_of` has the same value. `key_of` is a function of a CountsKey, or a
/// pointer to one of its members.
template <class KeyOf>
auto sums_by(const Statistics& statistics, const KeyOf& key_of) {
  std::map<std::decay_t<std::invoke_result_t<const KeyOf&, const CountsKey&>>, CountsSum> sums;
  for (const auto& [key, counts] : statistics.counts) sums[std::invoke(key_of, key)].add(key.family, counts);
  return sums;
}

}  // namespace nearmiss
