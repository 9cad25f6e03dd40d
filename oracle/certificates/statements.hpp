// Certificates of times and distances, which take several statements.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// The certificate of each statement; nothing for a statement without a proof.
using Certificates = std::vector<std::optional<std::string>>;

/// Proofs of the narrowest enclosure [lo, hi] of the earliest time: nothing happens in [0, lo), unless lo is
/// 0, and something happens in [lo, hi]. If there is no collision, the proof of that.
Certificates certify_time(const Query& query);

/// Proofs of the enclosure that minimum_distance(query) gives: the smallest distance is at least lo, unless
/// lo is 0, and at most hi, unless hi is infinite. If the smallest distance is exactly lo or hi, and only at
/// irrational times, there may be no proof of that. Then it is proved to be above the double before lo, or at
/// most the double after hi.
Certificates certify_distance(const Query& query);

}  // namespace nearmiss
