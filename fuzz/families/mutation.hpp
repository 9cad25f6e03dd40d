// Mutations of queries that know what a query is, for coverage-guided fuzzers.
#pragma once

#include <span>
#include <string_view>

#include "ccd/query.hpp"
#include "fuzz/random.hpp"

namespace nearmiss {

/// A sort of small change.
struct Mutation {
  std::string_view name;
  std::string_view about;
  /// The changed query; the same one if there is nothing to change. An overflow leaves coordinates that are not
  /// finite.
  Query (*apply)(Random& random, const Query& query);
};

/// All sorts, in the order in which they are listed.
std::span<const Mutation> mutations();

/// Another query, by one to three mutations. Half of these move something by a fraction, which climbs; the others are
/// of random sorts, which explores. Then half of the time contact is restored where the primitives nearly touch, so
/// that chains of mutations keep to collisions. Finite if `query` is.
Query mutated(Random& random, const Query& query);

/// Takes some vertices, axes, moments or single coordinates from one query, and the rest from the other.
Query crossed(Random& random, const Query& first, const Query& second);

}  // namespace nearmiss
