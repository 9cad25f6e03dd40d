// All built-in subjects: those of ccd/, and the oracle itself as one.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "ccd/subject.hpp"

namespace nearmiss {

/// subjects() and `exact`: the certified filter and exact arithmetic for what it leaves. It claims that there
/// is no false positive at all: its distance bound is 0.
std::vector<SubjectInfo> all_subjects();

/// make_subject, "exact" and "exact-scalar".
std::unique_ptr<Subject> make_any_subject(std::string_view name_or_path,
                                          std::optional<double> given_bound = std::nullopt);

}  // namespace nearmiss
