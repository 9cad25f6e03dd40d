// The oracle as a subject.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "ccd/subject.hpp"

namespace nearmiss {

/// The subjects `exact` and `exact-scalar`: the certified filter, then exact arithmetic for the queries that
/// it leaves undecided. `exact` decides many queries side by side, `exact-scalar` one at a time. Both claim
/// to have no false positives, so their distance bound is 0.
std::span<const SubjectInfo> exact_subjects();

/// Makes the one of these with the given name; nothing for any other name.
std::unique_ptr<Subject> try_make_exact(std::string_view name);

}  // namespace nearmiss
