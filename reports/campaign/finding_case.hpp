// Converts findings to cases.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "corpus/case.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// A copy of the finding that has the shrunk query in place of the original query, and no ratio, because the
/// ratio belongs to the original query.
Finding of_shrunk(const Finding& finding);

/// A case with the query of a finding. The case also records the true answer if the finding implies it.
Case to_case(const Finding& finding);

/// A name for the file of a finding's case: the sort of the finding, the subject, and `id`. In file names,
/// subjects with similar names, such as "a b" and "a;b", have the same text, so the ids of their cases must
/// differ.
std::string case_file_name(const Finding& finding, std::string_view id);

/// Turns a text into a part of a valid file name. Keeps letters, digits, '-' and '.', and replaces every
/// other character by '_'. If the text has more than 60 bytes, keeps only its beginning, and appends a hash
/// of the whole text.
std::string file_name(std::string text);

/// The lines of Finding::errors, without line ends.
std::vector<std::string> error_lines(const Finding& finding);

}  // namespace nearmiss
