// Subjects from shared objects (nearmiss_subject.h).
#pragma once

#include <memory>
#include <string>

#include "ccd/subject.hpp"

namespace nearmiss {

/// The subject that the shared object at `path` exports. Throws Error where the file cannot be loaded, has no
/// nearmiss_get_subject, has another abi, or lacks a function. Its decide() throws Error where the plug-in
/// returns an error.
std::unique_ptr<Subject> load_plugin(const std::string& path);

}  // namespace nearmiss
