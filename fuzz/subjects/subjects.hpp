// All subjects: the built-in ones by name, plug-ins by path.
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "ccd/subject.hpp"
#include "fuzz/subjects/built_in.hpp"
#include "fuzz/subjects/isolation/isolated_plugin.hpp"

namespace nearmiss {

/// Makes a built-in subject (as make_built_in), or the plug-in at a path, which runs in processes of its own
/// (isolation/) under `limits`. Throws Error for an unknown name.
std::unique_ptr<Subject> make_any_subject(std::string_view name_or_path,
                                          std::optional<double> given_bound = std::nullopt,
                                          const isolation::PluginLimits& limits = {});

}  // namespace nearmiss
