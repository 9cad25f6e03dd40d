// Namespaces for a plug-in, in which it can name no process outside and reach no network.
#pragma once

#include <cstdint>

namespace nearmiss::isolation {

/// Lets the first child of this process be process 1 of a new PID namespace. When process 1 ends, the system
/// ends every process of its namespace. The child also gets a network namespace, a mount namespace, and an
/// IPC namespace, with which the system removes its System V shared memory.
/// Returns false if the system refuses that to this user. Must be called before any thread starts.
bool enter_namespaces();

/// Takes the network away if the system allows that to this user. Must be called before any thread starts.
void leave_network();

/// Lets process 1 and its descendants see only their own namespace in /proc, which they cannot write to, and
/// gives them a /dev/shm of their own, of this size (0: half of the memory), for POSIX shared memory. If the
/// system refuses that, as it does in some containers, these folders stay as they are.
void mount_own_folders(std::uint64_t bytes);

}  // namespace nearmiss::isolation
