// Starts and ends the supervisor and the guard of a plug-in's process.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

#include "fuzz/stop.hpp"
#include "fuzz/subjects/isolation/handles.hpp"

namespace nearmiss::isolation {

struct SocketPair {
  Descriptor ours, theirs;

  /// Throws NoWorker if the system refuses sockets.
  SocketPair();
};

/// Waits until something can be read from a file, but no longer than the given time. Returns whether
/// something can be read from the file. A signal to nearmiss does not end the wait.
bool is_ready(int file, std::chrono::milliseconds time);

/// Starts nearmiss-worker, and ends it together with all processes that it started.
class Supervisor {
 public:
  /// Descriptors that the worker gets.
  struct Files {
    int replies, answers;
  };

  Supervisor() = default;
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;
  ~Supervisor();

  /// Starts the worker. Returns when the plug-in's process exists and waits for a request to load the
  /// plug-in. Throws NoWorker if the system starts no worker, and Stopped if `stop` becomes due while this
  /// function waits.
  void start(std::vector<std::string> arguments, const Files& files, const Stop& stop);
  /// Begins to end all processes of the worker. The destructor waits until they have ended.
  void dismiss() { status_.close(); }

  /// The plug-in's process.
  [[nodiscard]] pid_t process() const { return process_; }
  /// The process from which all processes of the worker descend.
  [[nodiscard]] pid_t worker() const { return worker_; }
  /// The socket on which the supervisor sends a `Status` when the plug-in's process has ended.
  [[nodiscard]] int socket() const { return status_.number(); }

 private:
  /// Receives the first `Status`, which names the plug-in's process. Returns false if no `Status` comes.
  [[nodiscard]] bool learns_process(const Stop& stop);
  /// Waits for the first `Status`. Returns false if no `Status` comes.
  [[nodiscard]] bool hears_from_worker(const Stop& stop) const;

  Descriptor status_;
  pid_t worker_ = -1;  ///< the child of nearmiss
  pid_t process_ = -1;
};

}  // namespace nearmiss::isolation
