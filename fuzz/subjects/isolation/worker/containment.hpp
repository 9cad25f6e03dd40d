// What a plug-in's process may not do, whatever code runs in it.
#pragma once

namespace nearmiss::isolation {

/// Closes all files except those of shared.hpp, and discards standard input and output.
void close_files();

/// Takes the network away if the system allows that to this user. Must be called before any thread starts.
void leave_network();

/// Lets the process and its descendants be at most `more` processes and threads more than their user has now. The
/// system does not apply this limit to root.
void limit_processes(unsigned long more);

}  // namespace nearmiss::isolation
