// One worker process, as the asking process sees it.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "ccd/subject.hpp"
#include "fuzz/subjects/isolation/shared.hpp"

namespace nearmiss::isolation {

/// The limits of a plug-in.
struct PluginLimits {
  /// Limit of the process's computing time per query. The elapsed time may be at most ten times longer.
  std::chrono::duration<double> time{1};
  std::uint64_t bytes = std::uint64_t{1}
                        << 30;  ///< limit of memory in addition to what loading took; 0 means no limit
};

/// Why a query has no answer.
struct WorkerFailure {
  std::uint32_t query;  ///< its index in the batch
  Fault fault;
  std::int32_t code;  ///< for a crash: the signal, or the negated exit code
};

/// A running worker. It cannot be used after a request has failed.
class WorkerProcess {
 public:
  /// Throws Error if the plug-in cannot be used.
  WorkerProcess(const std::string& path, const PluginLimits& limits);
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;
  ~WorkerProcess() = default;

  [[nodiscard]] Shared& shared() const { return *shared_; }

  /// Performs a request for the queries in shared(). Returns why one failed; nothing if all were completed.
  std::optional<WorkerFailure> perform(Request request) const;

 private:
  struct Descriptor {
    int number = -1;
    ~Descriptor();
  };
  struct Unmap {
    void operator()(Shared* memory) const;
  };
  struct Child {
    pid_t id = -1;
    ~Child();
  };

  /// How waiting for the worker ended: it is done, it died, or a query exceeded a limit.
  enum class How : std::uint8_t { done, dead, late };
  void start(const std::string& path, int memory);
  [[nodiscard]] How wait() const;
  [[nodiscard]] std::chrono::duration<double> computed() const;

  PluginLimits limits_;
  std::unique_ptr<Shared, Unmap> shared_;
  Descriptor socket_;
  Child process_;
};

}  // namespace nearmiss::isolation
