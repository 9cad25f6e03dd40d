// All subjects by name: the CCDs under test, the oracle as one, and the defective ones.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "ccd/subject.hpp"

namespace nearmiss {

/// Those of ccd/, and the oracle as a subject; defects are listed by `defects()`.
std::vector<SubjectInfo> all_subjects();

/// make_subject, the oracle's subjects, "NAME:SCALAR" (ladder/scalars.hpp) and "defect:NAME". Throws Error.
std::unique_ptr<Subject> make_any_subject(std::string_view name_or_path,
                                          std::optional<double> given_bound = std::nullopt);

}  // namespace nearmiss
