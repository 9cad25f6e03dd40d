// All subjects: the built-in ones by name, plug-ins by path or command.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "ccd/subject.hpp"
#include "fuzz/subjects/built_in.hpp"
#include "fuzz/subjects/isolation/isolated_plugin.hpp"

namespace nearmiss {

/// Makes a built-in subject (as make_built_in), or a plug-in, which runs in processes of its own (isolation/) under
/// `limits`. Throws Error for an unknown name.
std::unique_ptr<Subject> make_any_subject(std::string_view name,
                                          std::optional<double> given_bound = std::nullopt,
                                          const isolation::PluginLimits& limits = {});

/// The same, but all detectors of a shared object if the name does not say which.
std::vector<std::unique_ptr<Subject>> make_any_subjects(std::string_view name,
                                                        std::optional<double> given_bound = std::nullopt,
                                                        const isolation::PluginLimits& limits = {});

}  // namespace nearmiss
