#include "reports/statistics/extreme.hpp"

#include <limits>

namespace nearmiss {

void Extreme::merge(const Extreme& other) {
  const bool less = of == Of::keeping_tolerance;
  const bool more_extreme = less ? other.value < value : other.value > value;
  const bool as_extreme =
      other.value == value && other.found() && (!found() || other.provenance < provenance);
  const std::uint64_t sum = queries + other.queries;
  if (more_extreme || as_extreme) *this = other;
  queries = sum;
}

Extreme nothing_found(Extreme::Of of, std::string name) {
  const bool less = of == Extreme::Of::keeping_tolerance;
  return {of, std::move(name), less ? std::numeric_limits<double>::infinity() : 0, {}, {}, 0};
}

}  // namespace nearmiss
