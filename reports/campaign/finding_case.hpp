// Converts findings to cases, and their texts to lines.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "corpus/case.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// The finding with its shrunk query in place of the original one, and without the ratio of the original
/// query.
Finding of_shrunk(const Finding& finding);

/// The case of a finding, with its truth if the finding implies one.
Case to_case(const Finding& finding);

/// A name for the case's file: what failed, the subject, and an `id` that distinguishes it. Subjects with
/// similar names, such as "a b" and "a;b", get the same file name, so the id must distinguish their cases
/// too.
std::string case_file_name(const Finding& finding, std::string_view id);

/// A part of a valid file name: letters, digits, '-' and '.' stay, and every other character becomes '_'. A
/// text of more than 60 bytes is cut, and a hash of it added.
std::string file_name(std::string text);

/// The lines of Finding::errors, without their ends.
std::vector<std::string> error_lines(const Finding& finding);

}  // namespace nearmiss
