// Sums of a campaign's counters.
#pragma once

#include <functional>
#include <map>
#include <type_traits>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// The sums of counters by what `key_of` makes of their keys: a function, or a member of CountsKey.
template <class KeyOf>
auto sums_by(const Statistics& statistics, const KeyOf& key_of) {
  std::map<std::decay_t<std::invoke_result_t<const KeyOf&, const CountsKey&>>, CountsSum> sums;
  for (const auto& [key, counts] : statistics.counts) sums[std::invoke(key_of, key)].add(key.family, counts);
  return sums;
}

}  // namespace nearmiss
