// All subjects by name: the CCDs under test, the oracle, and the CCDs with defects.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "ccd/subject.hpp"
#include "fuzz/subjects/isolation/isolated_plugin.hpp"

namespace nearmiss {

/// The built-in subjects: those of ccd/, the exact subjects, and `adaptive`. `defects()` lists the defects.
std::vector<SubjectInfo> all_subjects();

/// Makes a built-in subject, "NAME:SCALAR" (ladder/scalars.hpp), "defect:NAME" (defects.hpp), or the plug-in
/// at a path, which runs in processes of its own (isolation/) under `limits`. `given_bound` is as for
/// make_subject. Throws Error for an unknown name.
std::unique_ptr<Subject> make_any_subject(std::string_view name_or_path,
                                          std::optional<double> given_bound = std::nullopt,
                                          const isolation::PluginLimits& limits = {});

}  // namespace nearmiss
