// The part of the worker that has the plug-in in its process.
#pragma once

#include <cstdint>

namespace nearmiss::isolation {

/// Loads a plug-in, by the name that the command line has for it, at the first request, and answers the others until the other end of `reply_socket` is closed.
/// Returns the exit code.
/// `bytes` limits the memory that the plug-in may use in addition to what loading took; 0 is no limit.
int answer_requests(const char* plugin, std::uint64_t bytes);

}  // namespace nearmiss::isolation
