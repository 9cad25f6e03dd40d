// Limits on the files and processes of a plug-in's process, and namespaces, in which it can name no process
// outside and reach no network.
#pragma once

#include <cstdint>

namespace nearmiss::isolation {

/// Closes all files except those of shared.hpp, and discards standard input and output.
void close_files();

/// Keeps crashes from writing a file "core", which could replace one of the user's.
void forbid_core_dumps();

/// When the system or a cgroup is out of memory, it ends the process or one of its descendants first. They can
/// undo that only where neither a namespace nor Landlock keeps them from writing to /proc.
void be_ended_first_for_want_of_memory();

/// Limits the processes and threads of the user to `more` above their present number. The limit binds this
/// process and its descendants; the system does not apply it to root.
void limit_processes(unsigned long more);

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
