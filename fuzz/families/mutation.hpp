// Structure-aware mutations of queries, for coverage-guided fuzzers.
#pragma once

#include <span>
#include <string_view>

#include "ccd/query/query.hpp"
#include "fuzz/random.hpp"

namespace nearmiss {

/// A kind of small change to a query.
struct Mutation {
  std::string_view name;
  std::string_view about;
  /// Returns the changed query, or the same query if there is nothing to change. An overflow results in
  /// coordinates that are not finite.
  Query (*apply)(Random& random, const Query& query);
};

/// All kinds of mutations, in the order in which they are listed.
std::span<const Mutation> mutations();

/// Applies one to three mutations. Half of them move something by a fraction, to improve a query step by
/// step; the others are of random kinds, to explore. In half of the cases contact is then restored where the
/// primitives nearly touch, so that chains of mutations stay near collisions. One case in four also changes a
/// separation h > 0; h = 0 never changes. The result is finite if `query` is.
Query mutated(Random& random, const Query& query);

/// Takes some vertices, axes, times or single coordinates from one query, and the rest from the other. The
/// separation is that of one of them.
Query crossed(Random& random, const Query& first, const Query& second);

}  // namespace nearmiss
