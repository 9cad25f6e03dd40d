// The part of the worker that runs in the plug-in's process.
#pragma once

#include <cstdint>

namespace nearmiss::isolation {

/// Answers requests until the other end of `reply_socket` is closed. The first request loads the plug-in;
/// `plugin` is the plug-in's name on the command line. Returns the exit code. `bytes` limits the memory that
/// the plug-in may use in addition to the memory that it took while it was loaded; if `bytes` is 0, there is
/// no limit.
int answer_requests(const char* plugin, std::uint64_t bytes);

}  // namespace nearmiss::isolation
