// Limits on the files and processes of a plug-in's process.
#pragma once

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

}  // namespace nearmiss::isolation
