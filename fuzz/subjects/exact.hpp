// The oracle's methods as subjects.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "ccd/subjects/subject.hpp"

namespace nearmiss {

/// The subjects `exact`, `exact-scalar` and `exact-decision`: the certified filter, then exact arithmetic for
/// queries that the filter leaves undecided. `exact` and `exact-decision` decide many queries without a
/// separation in parallel lanes; `exact-scalar` decides them one at a time. `exact` and `exact-scalar` give
/// the time of a collision: the largest double that is not after the collision's earliest time.
/// `exact-decision` gives no time. All three claim to have no false positives, so their distance bound is 0.
std::span<const SubjectInfo> exact_subjects();

/// The kinds of queries that a campaign asks by default: the kinds that at least one subject other than the
/// exact subjects can decide. If there is no such kind, for example because all subjects are exact, the
/// result is vt and ee. If the queries of a kind have separations, only subjects that take separations can
/// decide this kind.
std::vector<Kind> kinds_to_ask(std::span<const std::unique_ptr<Subject>> subjects,
                               const std::function<bool(Kind)>& has_separations);

inline constexpr SubjectInfo parity_info{
    "parity",
    "the root parity of Brochu, Edwards and Bridson, in rational numbers; its contract is one root"};

/// Makes the exact subject with the given name, or `parity`; returns null for any other name. `parity` asks
/// the oracle's root parity (oracle/parity/parity.hpp). That method is exact, but cannot distinguish an even
/// number of roots from no root. Therefore the contract of `parity` excludes queries with several roots or a
/// double root, and queries whose vertices are always coplanar. `parity` decides no vv and ve queries. Within
/// its contract, `parity` has no misses and no false positives, so its distance bound is 0.
std::unique_ptr<Subject> try_make_exact(std::string_view name);

}  // namespace nearmiss
