// Limits on the memory of the plug-in's process.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstdint>

namespace nearmiss::isolation {

/// After this call, `flag` becomes 1 whenever malloc(3) or mmap(2) refuses memory to this process.
void note_refusals_in(std::atomic<std::uint32_t>& flag);

/// Sets the flag that note_refusals_in() was given. Call this function after the system has refused memory to
/// this process.
void note_refusal();

/// Limits the memory that this process may take while it loads the plug-in. `more` is the limit for a query
/// (0: no limit). While the process loads the plug-in, it may take twice that amount, in addition to the
/// memory that it has when this function is called. Processes that this process starts inherit the limit.
/// This function does not limit the address space, because drivers of devices reserve much of it while the
/// plug-in is loaded. A file, on a disk or in memory, cannot become larger than `more` bytes; writing more is
/// an error.
void limit_memory_of_loading(std::uint64_t more);

/// Limits the address space of `process`, which is this process or its only child, to its present size plus
/// `more` bytes (0: no limit). Call this function after the plug-in has been loaded.
void limit_memory(pid_t process, std::uint64_t more);

}  // namespace nearmiss::isolation
