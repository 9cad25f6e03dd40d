// A CCD that first asks wang, the failure-proof CCD, and then removes wang's false positives.
#pragma once

#include <memory>
#include <string_view>

#include "ccd/subjects/subject.hpp"

namespace nearmiss {

inline constexpr SubjectInfo adaptive_info{
    "adaptive", "wang, whose reports are decided again: by the certified filter, in double-double, exactly"};

/// Makes `adaptive`; returns null for any other name. `adaptive` first asks wang, which misses nothing. The
/// oracle's certified filter checks wang's reports in double. If the filter is undecided, `adaptive` asks
/// wang:dd, which also misses nothing, and exact arithmetic checks the reports of wang:dd. So `adaptive` has
/// no misses and no false positives, and its distance bound is 0.
std::unique_ptr<Subject> try_make_adaptive(std::string_view name);

}  // namespace nearmiss
