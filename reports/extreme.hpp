// How much slack the tolerances have, as far as anyone has found.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "ccd/query.hpp"

namespace nearmiss {

/// The most extreme query that was found for one tolerance, or for one sort of tests.
struct Extreme {
  enum class Of : std::uint8_t {
    accepting_tolerance,  ///< the largest factor on it, all others as the paper has them, with which a
                          ///< collision is missed; 0 where none was found
    keeping_tolerance,  ///< of one that keeps degenerate primitives out: the smallest factor; infinity where none
    distance,           ///< the largest distance / bound of a false positive of these tests; 0 where none
  };

  Of of{};
  std::string name;  ///< of the tolerance or tests
  double value = 0;
  Query query;                ///< meaningless where none was found
  std::string provenance;     ///< of the query, empty where none was found
  std::uint64_t queries = 0;  ///< that were tried: collisions, or false positives

  [[nodiscard]] bool found() const { return !provenance.empty(); }

  /// Of two that are of the same: the more extreme query (of equal ones that of the lesser provenance), and
  /// all queries.
  void merge(const Extreme& other);

  bool operator==(const Extreme&) const = default;
};

/// Nothing found yet.
Extreme nothing_found(Extreme::Of of, std::string name);

/// "accepting-tolerance" and so on.
std::string_view name(Extreme::Of of);

}  // namespace nearmiss
