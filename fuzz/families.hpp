// Families of queries to hunt with: each query is a pure function of (family, seed, index).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "ccd/query.hpp"
#include "fuzz/random.hpp"

namespace nearmiss {

/// A way of making queries.
struct Family {
  std::string_view name;
  std::string_view about;
  bool planted;  ///< every query is a collision, by construction
  Query (*make)(Random& random, Kind kind);
};

/// All families, in the order in which they are listed.
std::span<const Family> families();

/// A family by its name. Throws Error that lists the known ones.
const Family& find_family(std::string_view name);

/// Query number `index` of a family: vertex-triangle where the index is even, edge-edge where it is odd.
Query make_query(const Family& family, std::uint64_t seed, std::uint64_t index);

}  // namespace nearmiss
