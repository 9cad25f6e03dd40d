// Queries of a family, counted.
#pragma once

#include <cstdint>
#include <string_view>

#include "fuzz/families/families.hpp"

namespace nearmiss::testing {

/// How many of the queries 0 .. 399 of a family have a property, with seed 5: `nearmiss family NAME --seed 5`.
template <class Property>
int count_of_400(std::string_view name, const Property& has_property) {
  const Family family = find_family(name);
  int count = 0;
  for (std::uint64_t i = 0; i < 400; ++i) count += has_property(nearmiss::make_query(family, 5, i)) ? 1 : 0;
  return count;
}

}  // namespace nearmiss::testing
