// The oracle as a subject.
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

/// The kinds that a campaign asks by default: those that at least one subject other than the exact ones can
/// be asked; without such a subject, vt and ee. A kind whose queries have separations needs a subject that
/// takes them.
std::vector<Kind> kinds_to_ask(std::span<const std::unique_ptr<Subject>> subjects,
                               const std::function<bool(Kind)>& has_separations);

/// Makes the exact subject with the given name; null for any other name.
std::unique_ptr<Subject> try_make_exact(std::string_view name);

}  // namespace nearmiss
