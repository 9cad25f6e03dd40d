// Whether there is memory for a large batch.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace nearmiss::isolation {

/// The memory in bytes that the machine has left, or that a control group (cgroups(7)) of this process has
/// left if that is less. It is read from the files below `root`.
std::uint64_t memory_left(const std::filesystem::path& root = "/");

/// Throws a TrialError unless that much memory is left. `what` needs it.
void expect_memory(const std::string& what, std::uint64_t bytes);

}  // namespace nearmiss::isolation
