// A CCD that begins with wang, the failure-proof CCD, and removes its false positives.
#pragma once

#include <memory>
#include <string_view>

#include "ccd/subjects/subject.hpp"

namespace nearmiss {

inline constexpr SubjectInfo adaptive_info{
    "adaptive", "wang, whose reports are decided again: by the certified filter, in double-double, exactly"};

/// wang decides first, and misses nothing. The oracle's certified filter decides wang's reports again, in
/// double. wang:dd, which also misses nothing, decides the queries that the filter leaves undecided, and
/// exact arithmetic decides the reports of wang:dd. So `adaptive` has no misses and no false positives, and
/// its distance bound is 0. Returns null for any other name.
std::unique_ptr<Subject> try_make_adaptive(std::string_view name);

}  // namespace nearmiss
