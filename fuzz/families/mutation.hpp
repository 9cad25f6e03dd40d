// Steps from one query to another that know what a query is: what coverage-guided fuzzers hunt with.
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
  /// The changed query; the same one where there is nothing to change. Coordinates that are not finite come
  /// out where something overflows.
  Query (*apply)(Random& random, const Query& query);
};

/// All sorts, in the order in which they are listed.
std::span<const Mutation> mutations();

/// Another query: one to three mutations, every other one of them by a fraction, which climbs, the others of
/// random sorts, which explore; and then, every other time, contact restored where the primitives nearly touch,
/// so that chains of mutations keep to collisions. Finite where `query` is.
Query mutated(Random& random, const Query& query);

/// Vertices, axes, the starts and the ends, or single coordinates of one query and the rest of the other.
Query crossed(Random& random, const Query& first, const Query& second);

}  // namespace nearmiss
