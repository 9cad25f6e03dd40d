// The built-in subjects by name: the CCDs of ccd/, the oracle's methods, and CCDs with a known defect.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "ccd/subjects/subject.hpp"

namespace nearmiss {

/// Lists the built-in subjects: those of ccd/, the exact subjects, `adaptive`, `parity` and
/// `wang:dd-normals`. The list omits the defects, which `defects()` lists, and all subjects "NAME:SCALAR"
/// other than `wang:dd-normals`.
std::vector<SubjectInfo> built_in_subjects();

/// Makes a built-in subject from its name, from "NAME:SCALAR" (ladder/scalars.hpp) or from "defect:NAME"
/// (defects.hpp). The parameter `given_bound` means the same as in make_subject(). Throws Error for an
/// unknown name.
std::unique_ptr<Subject> make_built_in(std::string_view name,
                                       std::optional<double> given_bound = std::nullopt);
/// Like make_built_in, but returns null for an unknown name.
std::unique_ptr<Subject> try_make_built_in(std::string_view name,
                                           std::optional<double> given_bound = std::nullopt);

}  // namespace nearmiss
