// How much memory the plug-in's process may use.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstdint>

namespace nearmiss::isolation {

/// From now on, `flag` becomes 1 whenever malloc(3) or mmap(2) refuse memory to this process.
void note_refusals_in(std::atomic<std::uint32_t>& flag);

/// Notes that another function was refused memory.
void note_refusal();

/// Limits the memory that this process may use in addition while the plug-in is loaded: to twice `more`, the
/// bytes that a query may use; 0 is no limit. Processes that it starts inherit the limit. Addresses are not
/// limited yet, because drivers of devices reserve many. No file, on a disk or in memory, may become larger
/// than `more`; to write more is an error.
void limit_memory_of_loading(std::uint64_t more);

/// Limits the memory that this process, or its only child, may use in addition to what it has after loading.
void limit_memory(pid_t process, std::uint64_t more);

}  // namespace nearmiss::isolation
