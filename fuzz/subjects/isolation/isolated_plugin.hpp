// A plug-in that may crash, hang and eat memory without harm to us.
#pragma once

#include <memory>
#include <string>

#include "ccd/subject.hpp"
#include "fuzz/subjects/isolation/worker_process.hpp"

namespace nearmiss {

/// The plug-in at a path, in worker processes: as many as threads ask at the same time. What goes wrong in
/// one is the verdict's fault, and the next query has a new process; what the plug-in prints is lost. Throws
/// Error where it cannot be loaded.
std::unique_ptr<Subject> make_isolated_plugin(const std::string& path,
                                              const isolation::PluginLimits& limits = {});

}  // namespace nearmiss
