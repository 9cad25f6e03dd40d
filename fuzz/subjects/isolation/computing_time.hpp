// The computing time and the memory of a process and its descendants.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>

namespace nearmiss::isolation {

using Duration = std::chrono::duration<double>;

/// The computing time of all threads of a process; 0 if there is no such process.
Duration computing_time(pid_t process);

/// Computing times of several processes.
struct ComputingTime {
  Duration running{};  ///< the computing time of processes that still exist
  /// The computing time of ended processes that their parents have waited for. This time is accurate to a
  /// clock tick.
  Duration ended{};

  [[nodiscard]] Duration sum() const { return running + ended; }
};

/// The length of a clock tick, which limits the accuracy of ComputingTime::ended.
Duration clock_tick();

/// The computing time of a process and all its descendants. Descendants are found only if the kernel has the
/// files /proc/PID/task/TID/children (proc(5)), as the kernels of distributions have.
ComputingTime computing_time_of_tree(pid_t root);

/// The largest Memory::data, in bytes, among a process and its descendants. Descendants are found as in
/// computing_time_of_tree().
std::uint64_t largest_data_of_tree(pid_t root);

}  // namespace nearmiss::isolation
