// Quantiles of counts in bins.
#pragma once

#include <cstdint>
#include <functional>
#include <iterator>

namespace nearmiss {

/// An iterator to the bin at which the running sum of counts reaches a fraction `part` of all counts; the
/// end of `bins` if all bins are empty. `count_of` returns the count of a bin.
template <class Bins, class CountOf = std::identity>
auto quantile_bin(const Bins& bins, double part, const CountOf& count_of = {}) {
  double all = 0;
  for (const auto& bin : bins) all += static_cast<double>(count_of(bin));
  double sum = 0;
  for (auto bin = std::begin(bins); bin != std::end(bins); ++bin) {
    sum += static_cast<double>(count_of(*bin));
    if (sum > 0 && sum >= part * all) return bin;
  }
  return std::end(bins);
}

}  // namespace nearmiss
