// Root parity as a subject.
#pragma once

#include <memory>
#include <string_view>

#include "ccd/subjects/subject.hpp"

namespace nearmiss {

inline constexpr SubjectInfo parity_info{
    "parity",
    "the root parity of Brochu, Edwards and Bridson, in rational numbers; its contract is one root"};

/// Asks the oracle's method `parity` (oracle/parity/parity.hpp): exact, but it takes an even number of roots for
/// none. Its contract leaves out queries of which it knows nothing: those with several roots or a double one, and
/// those whose vertices are always coplanar. It is not asked about vertices and edges on their own. Within the
/// contract it has no misses and no false positives, so its distance bound is 0. Returns null for any other
/// name.
std::unique_ptr<Subject> try_make_parity(std::string_view name);

}  // namespace nearmiss
