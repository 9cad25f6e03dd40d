// The part of the worker that runs in the plug-in's process.
#pragma once

#include <cstdint>

namespace nearmiss::isolation {

/// Loads a plug-in, given by its name on the command line, at the first request, and answers later requests
/// until the other end of `reply_socket` is closed. Returns the exit code. `bytes` limits the memory that the
/// plug-in may use in addition to what loading took; 0 is no limit.
int answer_requests(const char* plugin, std::uint64_t bytes);

}  // namespace nearmiss::isolation
