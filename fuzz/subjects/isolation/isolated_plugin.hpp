// Runs a plug-in in worker processes, so that it may crash, hang or exhaust memory.
#pragma once

#include <memory>
#include <string>

#include "ccd/subject.hpp"
#include "fuzz/subjects/isolation/worker_process.hpp"

namespace nearmiss {

/// The plug-in at a path, with one worker process for each thread that asks at the same time. A failure
/// becomes the verdict's fault, and the next query gets a new process. The plug-in's output is discarded.
/// Throws Error if the plug-in cannot be loaded.
std::unique_ptr<Subject> make_isolated_plugin(const std::string& path,
                                              const isolation::PluginLimits& limits = {});

}  // namespace nearmiss
