// The failure-proof CCD without its false positives.
#pragma once

#include <memory>
#include <string_view>

#include "ccd/subject.hpp"

namespace nearmiss {

inline constexpr SubjectInfo adaptive_info{
    "adaptive", "wang; what it reports is decided again: by the certified filter, in double-double, exactly"};

/// Asks wang first, which misses nothing. What it reports the oracle's certified filter decides, in double;
/// what that leaves wang:dd, which still misses nothing; and what that reports too exact arithmetic. So it
/// misses nothing and reports nothing falsely: its distance bound is 0. Nothing for another name.
std::unique_ptr<Subject> try_make_adaptive(std::string_view name);

}  // namespace nearmiss
