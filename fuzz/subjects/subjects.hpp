// All subjects: the built-in ones and published CCDs by name, plug-ins by path or command.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ccd/subject.hpp"
#include "fuzz/subjects/built_in.hpp"
#include "fuzz/subjects/isolation/isolated_plugin.hpp"

namespace nearmiss {

/// The plug-in that a name stands for: a path or a command stands for itself, the name of a published CCD for the plug-in
/// that was built of it (peers.hpp). Nothing for other names. Throws Error if the CCD is not built.
std::optional<std::string> plugin_named(std::string_view name);

/// Makes a built-in subject (as make_built_in), or a plug-in (plugin_named), which runs in processes of its own (isolation/)
/// under `limits`. Throws Error for an unknown name.
std::unique_ptr<Subject> make_any_subject(std::string_view name,
                                          std::optional<double> given_bound = std::nullopt,
                                          const isolation::PluginLimits& limits = {});

/// The same, but all detectors of a shared object if the name does not say which.
std::vector<std::unique_ptr<Subject>> make_any_subjects(std::string_view name,
                                                        std::optional<double> given_bound = std::nullopt,
                                                        const isolation::PluginLimits& limits = {});

}  // namespace nearmiss
