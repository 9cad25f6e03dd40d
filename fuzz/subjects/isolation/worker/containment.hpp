// Limits the files and processes of a plug-in's process. Puts this process into namespaces, in which it can
// reach neither outside processes nor the network.
#pragma once

#include <cstdint>

namespace nearmiss::isolation {

/// Closes all file descriptors except those that shared.hpp names, and replaces standard input, output and
/// error by /dev/null.
void close_files();

/// Prevents a crash of this process from writing a file "core", which could replace a file of the user.
void forbid_core_dumps();

/// Asks the system to end this process or one of its descendants before all other processes when the system
/// or a cgroup is out of memory. If neither a namespace nor Landlock keeps these processes from writing to
/// /proc, they can withdraw this request.
void be_ended_first_for_want_of_memory();

/// Limits the number of the user's processes and threads to the present number plus `more`. The limit stops
/// only this process and its descendants from starting more processes; the system does not apply the limit to
/// root.
void limit_processes(unsigned long more);

/// Makes the first child of this process become process 1 of a new PID namespace. When process 1 ends, the
/// system ends every process of its namespace. The child also gets a network namespace, a mount namespace,
/// and an IPC namespace. When the IPC namespace ends, the system removes its System V shared memory. Returns
/// false if the system refuses namespaces to this user. Must be called before any thread starts.
bool enter_namespaces();

/// Leaves the network, if the system allows this user to do so. Must be called before any thread starts.
void leave_network();

/// Gives process 1 and its descendants folders of their own: a read-only /proc that shows only their
/// namespace, a /dev/shm for POSIX shared memory, which can hold `bytes` bytes (if `bytes` is 0: half of the
/// machine's memory), and a /dev/pts for terminals. If the system refuses to mount them, as in some
/// containers, these folders stay as they are.
void mount_own_folders(std::uint64_t bytes);

}  // namespace nearmiss::isolation
