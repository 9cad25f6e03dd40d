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
/// queries that the filter leaves undecided. `exact` decides many queries with h = 0 in parallel lanes,
/// `exact-scalar` one at a time. Both give the largest double that is not after the earliest time;
/// `exact-decision` gives no time. All three claim to have no false positives, so their distance bound is 0.
std::span<const SubjectInfo> exact_subjects();

/// The kinds of queries that a campaign asks by default: the kinds that at least one subject can decide, not
/// counting the exact subjects. If all subjects are exact, vt and ee. If the queries of a kind have
/// separations, only subjects that take separations can decide them.
std::vector<Kind> kinds_to_ask(std::span<const std::unique_ptr<Subject>> subjects,
                               const std::function<bool(Kind)>& has_separations);

inline constexpr SubjectInfo parity_info{
    "parity",
    "the root parity of Brochu, Edwards and Bridson, in rational numbers; its contract is one root"};

/// Makes the exact subject with the given name, or `parity`; null for any other name. `parity` asks the
/// oracle's method of this name (oracle/parity/parity.hpp). This method is exact, but cannot distinguish an
/// even number of roots from no root. Therefore its contract excludes queries with several roots or a double
/// root, and queries whose vertices are always coplanar. It does not decide vv and ve queries. Within the
/// contract it has no misses and no false positives, so its distance bound is 0.
std::unique_ptr<Subject> try_make_exact(std::string_view name);

}  // namespace nearmiss
