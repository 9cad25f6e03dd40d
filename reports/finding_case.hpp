// Findings as cases to keep.
#pragma once

#include <string>
#include <string_view>

#include "corpus/case.hpp"
#include "reports/statistics.hpp"

namespace nearmiss {

/// The case of a finding: says what was found, with its truth where the finding implies one.
Case to_case(const Finding& finding);

/// A name for the case's file: what was found, of which subject, and `id`, which tells it from others.
std::string case_file_name(const Finding& finding, std::string_view id);

/// A name that is a good file name: letters, digits, '-' and '.' stay, all else becomes '_'.
std::string file_name(std::string text);

}  // namespace nearmiss
