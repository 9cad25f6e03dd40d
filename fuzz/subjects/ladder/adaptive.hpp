// The failure-proof CCD without its false positives.
#pragma once

#include <memory>
#include <string_view>

#include "ccd/subject.hpp"

namespace nearmiss {

inline constexpr SubjectInfo adaptive_info{
    "adaptive", "wang; what it reports is decided again: by the certified filter, in double-double, exactly"};

/// wang decides first, which misses nothing. The oracle's certified filter decides again what wang reports, in double;
/// wang:dd, which also misses nothing, decides what the filter leaves; exact arithmetic decides what wang:dd reports.
/// So `adaptive` misses nothing and reports nothing falsely: its distance bound is 0. Nothing for another name.
std::unique_ptr<Subject> try_make_adaptive(std::string_view name);

}  // namespace nearmiss
