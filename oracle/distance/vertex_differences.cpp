#include "oracle/distance/vertex_differences.hpp"

#include <algorithm>
#include <cmath>

namespace nearmiss::certified {

VertexDifferences::VertexDifferences(const Query& query)
    : kind_(query.kind), exponent_(0), pairs_{}, total_reach_(0) {
  double largest = 0;
  // Sets all differences of coordinates, times a factor. Returns whether these differences, and the sum of
  // their magnitudes, are finite.
  const auto subtract = [&](double factor) {
    // Each component has its own sum and maximum, so that the operations do not wait for each other.
    Vec<double> most{};
    Vec<double> sums{};
    for_each_pair(kind_, [&](std::size_t i, std::size_t j) {
      for (std::size_t time = 0; time < 2; ++time)
        for (std::size_t k = 0; k < 3; ++k) {
          const auto coordinate = [&](std::size_t vertex) {
            return factor * query.x[12 * time + 3 * vertex + k];
          };
          const DoubleWord value = two_sum(coordinate(i), -coordinate(j));
          pairs_[number_of_pair(i, j)].at[time][k] = value;
          sums[k] += std::abs(value.hi) + std::abs(value.lo);
          most[k] = std::max(most[k], std::abs(value.hi));
        }
    });
    largest = std::max({most[0], most[1], most[2]});
    return std::isfinite(sums[0] + sums[1] + sums[2]);
  };
  if (!subtract(1)) {
    subtract(0x1p-6);
    exponent_ = 6;
  }
  const int size = largest > 0 ? std::ilogb(largest) : 0;
  exponent_ += size;
  scale(-size);
}

void VertexDifferences::scale(int exponent) {
  // Multiplies by two factors, because 2^exponent need not be a double.
  const double factor = std::ldexp(1.0, exponent / 2);
  const double other_factor = std::ldexp(1.0, exponent - exponent / 2);
  for_each_pair(kind_, [&](std::size_t i, std::size_t j) {
    VertexDifference& pair = pairs_[number_of_pair(i, j)];
    double reach = 0;
    for (Vec<DoubleWord>& v : pair.at)
      for (DoubleWord& c : v) {
        c = {c.hi * factor * other_factor, c.lo * factor * other_factor};
        reach = std::max(reach, std::abs(c.hi));
      }
    constexpr double root_of_three = 1.7320508075688777;  // rounded up
    pair.reach = root_of_three * reach;
    total_reach_ += pair.reach;
  });
}

}  // namespace nearmiss::certified
