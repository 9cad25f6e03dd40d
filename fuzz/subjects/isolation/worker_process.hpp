// Starts and asks a worker process. Trusts nothing that the worker writes.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ccd/subjects/detector.hpp"
#include "ccd/subjects/subject.hpp"
#include "fuzz/stop.hpp"
#include "fuzz/subjects/isolation/computing_time.hpp"
#include "fuzz/subjects/isolation/handles.hpp"
#include "fuzz/subjects/isolation/plugin_code.hpp"
#include "fuzz/subjects/isolation/shared.hpp"
#include "fuzz/subjects/isolation/supervisor.hpp"

namespace nearmiss::isolation {

struct PluginLimits {
  /// The computing time that a query may take, summed over all threads and processes of the plug-in. The
  /// query may take ten times as much wall-clock time.
  Duration time{1};
  /// The memory, in bytes, that the plug-in may take in addition to the memory that it took while it was
  /// loaded. If this is 0, there is no limit.
  std::uint64_t bytes = std::uint64_t{1} << 30;
  Duration loading{30};   ///< the time that loading the plug-in may take
  Duration leaving{0.1};  ///< the time that closing the detector may take
  /// Once this many queries of a call have exceeded the time limit, nearmiss does not ask the remaining
  /// queries of the call. If this is 0, there is no limit.
  std::uint64_t most_late = 0;
  const Stop* stop = &Stop::never();  ///< when this stop is due, every function that waits throws Stopped
  /// Whether the plug-in gets a PID namespace of its own, if the system allows that.
  bool own_namespace = true;
};

/// The largest number of queries that a worker gets at once: the number that the detector wants, but at least
/// least_capacity.
constexpr std::size_t capacity_for(const DetectorInfo& info) { return std::max(least_capacity, info.batch); }

/// The bytes of memory that a worker shares with nearmiss for a batch of `queries` queries. If the worker
/// does not take such a large batch, this function returns the bytes for the largest batch that the worker
/// takes. Throws a TrialError if a batch of more than least_capacity queries needs more memory than the
/// plug-in's limit.
std::uint64_t memory_of_batch(const DetectorInfo& info, std::size_t queries, const PluginLimits& limits);

/// A request about several queries may take this many times the limit of one query.
inline constexpr double call_limit = 10;
/// A detector may take this many times the limit of one query if it decides `queries` queries at once.
constexpr double limit_of_batch(std::size_t queries) {
  constexpr double of_each = 1e-3;
  return std::min(call_limit, 1 + of_each * static_cast<double>(queries - 1));
}

/// Why a query has no answer.
struct WorkerFailure {
  std::uint32_t query;  ///< the index of this query in the batch
  Fault fault;
  std::int32_t code = 0;  ///< for a crash: the signal, or the exit code times -1
  /// For an exception: the exception's message; for a failure to load the plug-in: the reason.
  std::string text = {};
  std::string errors = {};  ///< if the process has ended: the end of the text that it wrote to standard error
  /// 0 if `query` caused the failure. Otherwise, the number of queries, from `query` on, that were asked
  /// together; any of these queries may have caused the failure.
  std::uint32_t suspects = 0;
  bool goes_on = false;  ///< whether the worker can still be used for other queries
};

/// Checks a worker's description of its plug-in, and returns it with printable texts. `options` has the
/// options that the plug-in was given. Throws Error if no detector can have such a description.
DetectorInfo info_of(const PluginDescription& about, const std::string& options);
/// The names of all detectors in the shared object. Throws Error for an invalid name, or too many names.
std::vector<std::string> names_of(const PluginDescription& about);

/// A running worker. After a failed call, it cannot be used any more, unless WorkerFailure::goes_on is true.
class WorkerProcess {
 public:
  /// Throws Error if the plug-in cannot be used, NoWorker if no process can be started, PluginChanged if the
  /// file was changed, and Stopped if the stop in `limits` is due.
  WorkerProcess(const PluginCode& file, const PluginLimits& limits);
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;
  ~WorkerProcess();

  /// Begins to end the worker; the destructor waits for the end. To end several workers at the same time,
  /// call dismiss() for all of them before their destructors. A worker that waits for a call closes its
  /// detector and exits by itself, if it can do so in time.
  void dismiss();

  /// The plug-in's description of itself; all text is printable.
  [[nodiscard]] const DetectorInfo& info() const { return info_; }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

  /// Makes the worker perform a request for a batch of at most capacity_for(info()) queries of one kind.
  /// Returns the first failure, or nothing if the worker answered all queries. Throws Stopped if the stop in
  /// the limits is due, and TrialError if the system has too little memory for the batch.
  std::optional<WorkerFailure> perform(Request request, std::span<const Query> queries);

  /// The plug-in's decision on query i of the batch, as in nearmiss_subject.h.
  [[nodiscard]] int value(std::uint32_t i) const { return batch_.values()[i]; }
  /// The time of impact, bound, distance or clearance that the plug-in gave for query i of the batch.
  [[nodiscard]] double number(std::uint32_t i) const { return batch_.numbers()[i]; }
  /// The other numbers in the answer to a question about one query: weights, or positions.
  [[nodiscard]] const std::array<double, 12>& more() const { return answers_->more; }
  /// The time in ns that the worker measured in the last call: measured() is the time of the whole call, and
  /// measured(i) is the time of query i. If a time exceeds both the duration of the call and the computing
  /// time of the call, as nearmiss measured them, it is lowered to the longer of the two. The time of the
  /// whole call is also raised to at least half of the computing time of all threads and processes of the
  /// plug-in, less the computing time that the worker itself may need. The factor is one half because the
  /// plug-in may have decided each query twice. The time of the first call is not raised.
  [[nodiscard]] std::uint64_t measured() const { return limited(answers_->nanoseconds, least_); }
  [[nodiscard]] std::uint64_t measured(std::uint32_t i) const {
    return limited(batch_.nanoseconds()[i], Duration{});
  }
  /// Returns the time that the last call took apart from copies to and from a device. The plug-in states this
  /// time; a time above measured() is replaced by measured(). Returns 0 if the plug-in does not state a time.
  [[nodiscard]] std::uint64_t measured_kernels() const {
    return std::min(answers_->kernel_nanoseconds, measured());
  }
  /// The computing time of the last call.
  [[nodiscard]] Duration elapsed() const { return elapsed_.computing; }

 private:
  /// How a call ended, in the order of the values: the worker answered the call; the plug-in threw an
  /// exception; the process died; a query took too long; the whole call took too long; loading took too much
  /// memory; the worker closed its socket, or wrote something to it that is no reply.
  enum class End : std::uint8_t { done, threw, dead, query_late, call_late, too_large, broken };

  /// The computing time of the worker, and the wall-clock time, since some moment.
  struct Elapsed {
    Duration computing{};
    Duration passed{};   ///< the wall-clock time, without the time in which nearmiss was suspended
    Duration certain{};  ///< the part of the computing time that is known to belong to this call
    [[nodiscard]] bool exceeds(const Elapsed& limit) const;
    /// The limit for work that may compute for this long, and may also wait for a device or a processor.
    static Elapsed with_waiting(Duration computing);
  };
  class Watch;

  void start(const std::string& plugin);
  void load(const std::string& plugin);
  void share();
  /// Reserves memory for a batch of this size. Throws TrialError if the system has too little memory.
  void reserve(std::size_t queries);
  /// Writes a batch to the shared memory.
  void give(std::span<const Query> queries);
  [[nodiscard]] Duration own_computing() const;
  /// Updates others_ and others_compute_. This takes longer than a call of a fast plug-in. Therefore, the
  /// update is made in every call only if the plug-in has started processes that compute; otherwise, it is
  /// made in every 16th call.
  void look_at_others();
  /// Sends a call to the worker, and waits for the worker's reply.
  End ask(const Call& call, const Elapsed& of_query, const Elapsed& of_call);
  /// Does the same as `ask`, except that it does not update is_waiting_.
  End sent(const Call& call, const Elapsed& of_query, const Elapsed& of_call);
  /// Sends a call; if its request is Request::share, also sends the files of the shared memory.
  void send_call(const Call& call) const;
  /// How the call ended; nothing if neither the worker nor its supervisor has sent a message.
  [[nodiscard]] std::optional<End> end_of(std::uint64_t call);
  [[nodiscard]] std::optional<End> read_reply(std::uint64_t call) const;
  /// The largest Memory::data of a process of the plug-in, in bytes.
  [[nodiscard]] std::uint64_t data() const;
  /// Whether the supervisor reports within this time that the process has ended.
  bool ends_within(std::chrono::milliseconds time);
  [[nodiscard]] WorkerFailure failure(End end, std::uint32_t query) const;
  [[nodiscard]] std::uint64_t limited(std::uint64_t nanoseconds, Duration least) const;

  PluginLimits limits_;
  SharedMemory header_{"nearmiss-worker", sizeof(SharedAnswers), true};
  SharedAnswers* answers_ = new (header_.as<void>()) SharedAnswers;
  SharedMemory questions_of_batch_, answers_of_batch_;
  BatchMemory batch_{};                    ///< the batch of the last call
  std::size_t reserved_ = least_capacity;  ///< the number of queries for which memory is reserved
  Descriptor replies_;
  Supervisor supervisor_;
  Status ended_{};  ///< how the plug-in's process ended
  std::uint64_t call_ = 0;
  /// The limit of data() while the plug-in is being loaded, if memory is limited at all.
  std::uint64_t most_data_ = 0;
  bool is_waiting_ = false;                                         ///< whether the worker waits for a call
  std::optional<std::chrono::steady_clock::time_point> leaves_by_;  ///< set by dismiss()
  Elapsed elapsed_;                                                 ///< the times of the last call
  /// The computing time of all processes of the worker except the plug-in's process.
  ComputingTime others_;
  bool others_compute_ = false;  ///< whether a process that the plug-in has started uses computing time
  Duration suspended_{};         ///< the time for which nearmiss was suspended during all calls so far
  Duration least_{};             ///< the lower limit of measured() for the last call
  DetectorInfo info_;
  std::vector<std::string> names_;
};

}  // namespace nearmiss::isolation
