// The oracle as a subject.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "ccd/subject.hpp"

namespace nearmiss {

/// `exact` and `exact-scalar`: the certified filter and exact arithmetic for what it leaves, many queries
/// side by side or one at a time. They claim that there is no false positive at all: their distance bound is
/// 0.
std::span<const SubjectInfo> exact_subjects();

/// One of these by its name; nothing for another name.
std::unique_ptr<Subject> try_make_exact(std::string_view name);

}  // namespace nearmiss
