// The median of measurements.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace nearmiss::tools {

/// The median of the numbers that are not NaN; for an even number of them, the upper of the two in the
/// middle. NaN if there are none.
inline double median(std::vector<double> numbers) {
  std::erase_if(numbers, [](double number) { return std::isnan(number); });
  if (numbers.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

}  // namespace nearmiss::tools
