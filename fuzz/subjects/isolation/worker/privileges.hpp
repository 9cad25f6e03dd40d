// Limits on what the plug-in's process can do to other processes.
#pragma once

namespace nearmiss::isolation {

/// Gives up every privilege (capabilities(7)) except root's rights to files, for this process and all
/// processes that it starts. Afterwards, this process can neither trace a process that has more privileges,
/// such as its supervisor, nor read the memory of such a process.
void drop_privileges();

/// Forbids this process, and all processes that it starts, to use the keyrings of the user (keyrings(7)) or
/// to change settings of terminals. So these processes cannot stop the output of the user's terminal. Call
/// drop_privileges() first. Does nothing if the kernel has no filters of system calls, and does nothing on
/// machines other than x86-64 and AArch64.
void keep_out_of_keyrings_and_terminals();

/// Limits this process and all processes that it starts. They can send signals only to this process. They
/// cannot change the priority, processors or limits of any other process, cannot trace any process, and
/// cannot leave their process group. Meant for a process without a PID namespace of its own. Call
/// drop_privileges() first; this function needs no privilege. Does nothing where
/// keep_out_of_keyrings_and_terminals() does nothing.
void confine_to_itself();

/// Limits this process and all processes that it starts. They cannot read the memory, environment and open
/// files of any other process, although /proc shows these to processes of the same user. They can write
/// neither to /proc nor to new files directly in /. Call drop_privileges() first. Does nothing if the kernel
/// has no Landlock.
void keep_out_of_other_processes();

}  // namespace nearmiss::isolation
