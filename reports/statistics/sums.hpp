// Sums of a campaign's counters.
#pragma once

#include <functional>
#include <map>
#include <type_traits>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// Adds up the counters whose keys have the same `key_of`, which is a function of CountsKey, or a member of
/// it.
template <class KeyOf>
auto sums_by(const Statistics& statistics, const KeyOf& key_of) {
  std::map<std::decay_t<std::invoke_result_t<const KeyOf&, const CountsKey&>>, CountsSum> sums;
  for (const auto& [key, counts] : statistics.counts) sums[std::invoke(key_of, key)].add(key.family, counts);
  return sums;
}

}  // namespace nearmiss
