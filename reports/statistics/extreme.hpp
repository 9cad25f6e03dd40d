// How much slack the tolerances have: the most extreme queries that were found.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "ccd/query.hpp"

namespace nearmiss {

/// The most extreme query that was found for one tolerance, or for one sort of tests.
struct Extreme {
  enum class Of : std::uint8_t {
    accepting_tolerance,  ///< the largest factor with which a collision is missed; 0 if no factor misses one
    keeping_tolerance,  ///< the smallest such factor on a tolerance that keeps degenerate primitives out; infinity if
                        ///< no factor misses one
    distance,  ///< the largest distance / bound of a false positive of these tests; 0 without false positives
  };

  Of of{};
  std::string name;           ///< of the tolerance or tests
  double value = 0;           ///< a factor is on this tolerance alone, all others as the paper has them
  Query query;                ///< meaningless if nothing was found
  std::string provenance;     ///< of the query; empty if nothing was found
  std::uint64_t queries = 0;  ///< number of collisions or false positives that were tried

  [[nodiscard]] bool found() const { return !provenance.empty(); }

  /// Keeps the more extreme of two queries for the same tolerance or tests, or the one with the lesser provenance if they
  /// are equal; adds up the queries.
  void merge(const Extreme& other);

  bool operator==(const Extreme&) const = default;
};

/// Nothing found yet.
Extreme nothing_found(Extreme::Of of, std::string name);

/// Names of what an extreme is of, in order, as they stand in files and reports.
inline constexpr std::array<std::string_view, 3> extreme_names{"accepting-tolerance", "keeping-tolerance",
                                                               "distance"};

constexpr std::string_view name(Extreme::Of of) { return extreme_names[static_cast<std::size_t>(of)]; }

}  // namespace nearmiss
