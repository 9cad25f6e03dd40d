// Runs a plug-in in worker processes, so that it may crash, hang or exhaust memory.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ccd/subjects/detector.hpp"
#include "ccd/subjects/subject.hpp"
#include "fuzz/subjects/isolation/worker_process.hpp"

namespace nearmiss {

/// Makes a subject that asks the plug-in with this name (ccd/subjects/plugin.hpp) in worker processes.
/// Threads that ask at the same time use different workers. If the plug-in fails, the verdict has a fault,
/// and the next query gets a new process, except after an exception. What the plug-in writes to standard
/// output is discarded. Throws Error if the plug-in cannot be loaded, or if it has several detectors and the
/// name chooses none of them.
///
/// If a file of the plug-in is changed, calls throw isolation::PluginChanged, and the answers of the current
/// call are not used. If the system starts no worker for ten seconds, calls throw isolation::NoWorker.
std::unique_ptr<Subject> make_isolated_plugin(const std::string& name,
                                              const isolation::PluginLimits& limits = {});

/// Like make_isolated_plugin, except that this function makes a subject of each detector if the file is a
/// shared object with several detectors and the name chooses none of them.
std::vector<std::unique_ptr<Subject>> make_isolated_plugins(const std::string& name,
                                                            const isolation::PluginLimits& limits = {});

struct PluginIdentity {
  std::string path;      ///< path or command with options, as given; with the detector's name if the file has
                         ///< several detectors
  std::string version;   ///< the version that the plug-in states; "" if it states none
  std::string sha256;    ///< PluginCode::sha256()
  std::string build_id;  ///< PluginCode::build_id()
};

/// The identity of a subject's code, if make_isolated_plugin made the subject.
std::optional<PluginIdentity> plugin_identity(const Subject& subject);

/// A subject's description of itself, if make_isolated_plugin made the subject; null otherwise.
const DetectorInfo* plugin_info(const Subject& subject);

}  // namespace nearmiss
