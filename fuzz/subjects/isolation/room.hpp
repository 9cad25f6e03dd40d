// Checks that the system has enough memory left for a large batch.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace nearmiss::isolation {

/// The memory, in bytes, that is left for this process. This is the memory that the machine has left, or, if
/// it is less, the memory that a control group (cgroups(7)) of the process has left. Reads files below
/// `root`.
std::uint64_t memory_left(const std::filesystem::path& root = "/");

/// Throws a TrialError unless this many bytes are left. The message says that `what` needs these bytes.
void expect_memory(const std::string& what, std::uint64_t bytes);

}  // namespace nearmiss::isolation
