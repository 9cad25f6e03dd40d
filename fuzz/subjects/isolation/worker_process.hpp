// One worker process, from the side of the one that asks.
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

/// What a plug-in may use.
struct PluginLimits {
  /// A query is over it when its process has computed for so long, or ten times as long has gone by.
  std::chrono::duration<double> time{1};
  std::uint64_t bytes = std::uint64_t{1} << 30;  ///< more than loading it took; 0: any
};

/// What became of a query that was not answered.
struct WorkerFailure {
  std::uint32_t query;  ///< its place in the batch
  Fault fault;
  std::int32_t code;  ///< of a crash: the signal, or the exit code negated
};

/// A running worker. It is of no use any more once a request failed.
class WorkerProcess {
 public:
  /// Throws Error where the plug-in cannot be used.
  WorkerProcess(const std::string& path, const PluginLimits& limits);
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;
  ~WorkerProcess() = default;

  [[nodiscard]] Shared& shared() const { return *shared_; }

  /// Has everything that stands in shared() done; nothing where that is so.
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

  /// How waiting for the worker ended: it is done, or it died, or a query is over its limit.
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
