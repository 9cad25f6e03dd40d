// Root parity as a subject.
#pragma once

#include <memory>
#include <string_view>

#include "ccd/subjects/subject.hpp"

namespace nearmiss {

inline constexpr SubjectInfo parity_info{
    "parity",
    "the root parity of Brochu, Edwards and Bridson, in rational numbers; its contract is one root"};

/// Makes `parity`, which asks the oracle's method of this name (oracle/parity/parity.hpp); returns null for
/// any other name. The method is exact, but takes an even number of roots for none. Therefore the contract
/// excludes queries with several roots or a double root, and queries whose vertices are always coplanar.
/// `parity` does not decide vv and ve queries. Within the contract it has no misses and no false positives,
/// so its distance bound is 0.
std::unique_ptr<Subject> try_make_parity(std::string_view name);

}  // namespace nearmiss
