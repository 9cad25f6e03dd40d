#include "reports/campaign/complexity.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace nearmiss {

namespace {

/// The contribution of a magnitude to Complexity::awkward.
int awkwardness(double magnitude) {
  if (magnitude < 10 && magnitude == std::floor(magnitude)) return 0;
  return magnitude < 100 && 4 * magnitude == std::floor(4 * magnitude) ? 1 : 2;
}

}  // namespace

Numbers numbers_of(const Query& query) {
  Numbers x;
  std::copy(query.x.begin(), query.x.end(), x.begin());
  x.back() = query.separation;
  return x;
}

std::vector<double> magnitudes(std::span<const double> numbers) {
  std::vector<double> all;
  for (const double number : numbers)
    if (number != 0) all.push_back(std::abs(number));
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

int significant_bits(double magnitude) {
  int exponent = 0;
  const double significand = std::ldexp(std::frexp(magnitude, &exponent), 53);
  return 53 - std::countr_zero(static_cast<std::uint64_t>(significand));
}

Complexity complexity(const Query& query) {
  Complexity sum;
  for (std::size_t i = 0; i < coordinate_count(query.kind) / 2; ++i) {
    const double start = query.x[i];
    const double end = query.x[12 + i];
    sum.moving += start == end ? 0 : 1;
    sum.numbers += (start == 0 ? 0 : 1) + (end == 0 || end == start ? 0 : 1);
    sum.negative += (std::signbit(start) ? 1 : 0) + (std::signbit(end) ? 1 : 0);
  }
  sum.numbers += query.separation == 0 ? 0 : 1;
  for (const double m : magnitudes(numbers_of(query))) {
    ++sum.distinct;
    sum.awkward += awkwardness(m);
    sum.bits += significant_bits(m);
    sum.exponents += std::abs(std::ilogb(m));
  }
  return sum;
}

}  // namespace nearmiss
