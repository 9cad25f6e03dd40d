// The most extreme queries that a search has found. They show how much slack the paper's tolerances have.
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
    /// The largest factor such that the algorithm misses a collision if the tolerance is multiplied by the
    /// factor; 0 if there is no such factor.
    accepting_tolerance,
    /// For a tolerance that keeps degenerate primitives out: the smallest factor such that the algorithm
    /// misses a collision if the tolerance is multiplied by the factor; infinity if there is no such factor.
    keeping_tolerance,
    /// The largest ratio distance / bound of the false positives of a group of tests; 0 without false
    /// positives.
    distance,
  };

  Of of{};
  std::string name;  ///< name of the tolerance or tests
  /// The factor by which the tolerance is multiplied; all other tolerances are the paper's. For a group of
  /// tests: the ratio distance / bound.
  double value = 0;
  Query query;                ///< meaningless if nothing was found
  std::string provenance;     ///< origin of the query; empty if nothing was found
  std::uint64_t queries = 0;  ///< number of collisions or false positives that were tried

  [[nodiscard]] bool found() const { return !provenance.empty(); }

  /// Merges the results of two searches for the same tolerance or tests. Keeps the more extreme query or, if
  /// the two queries are equally extreme, the query whose provenance comes first. Adds up the numbers of
  /// queries.
  void merge(const Extreme& other);

  bool operator==(const Extreme&) const = default;
};

/// The state of a search before it has found anything.
Extreme nothing_found(Extreme::Of of, std::string name);

/// The names of the values of Extreme::Of, as files and reports write them, in the order of the enumeration.
inline constexpr std::array<std::string_view, 3> extreme_names{"accepting-tolerance", "keeping-tolerance",
                                                               "distance"};

constexpr std::string_view name(Extreme::Of of) { return extreme_names[static_cast<std::size_t>(of)]; }

}  // namespace nearmiss
