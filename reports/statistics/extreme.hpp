// The most extreme queries that were found, which show how much slack the tolerances have.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// The most extreme query that was found for one tolerance, or for one group of tests.
struct Extreme {
  enum class Of : std::uint8_t {
    accepting_tolerance,  ///< the largest factor with which a collision is missed; 0 if no factor misses one
    keeping_tolerance,    ///< for a tolerance that keeps degenerate primitives out, the smallest factor
                          ///< with which a collision is missed; infinity if no factor misses one
    distance,  ///< the largest distance / bound of a false positive of these tests; 0 without false positives
  };

  Of of{};
  std::string name;           ///< name of the tolerance or tests
  double value = 0;           ///< a factor multiplies only this tolerance; all others are the paper's
  Query query;                ///< meaningless if nothing was found
  std::string provenance;     ///< origin of the query; empty if nothing was found
  std::uint64_t queries = 0;  ///< number of collisions or false positives that were tried

  [[nodiscard]] bool found() const { return !provenance.empty(); }

  /// Keeps the more extreme of two queries for the same tolerance or tests. If both are equally extreme,
  /// keeps the query with the lesser provenance. Adds up the numbers of queries.
  void merge(const Extreme& other);

  bool operator==(const Extreme&) const = default;
};

/// The state before anything is found.
Extreme nothing_found(Extreme::Of of, std::string name);

/// Names of the values of Extreme::Of in files and reports, in order.
inline constexpr std::array<std::string_view, 3> extreme_names{"accepting-tolerance", "keeping-tolerance",
                                                               "distance"};

constexpr std::string_view name(Extreme::Of of) { return extreme_names[static_cast<std::size_t>(of)]; }

}  // namespace nearmiss
