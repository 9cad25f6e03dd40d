// Memory and sockets that a worker process shares with nearmiss.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "ccd/query/query.hpp"
#include "ccd/subjects/detector.hpp"

namespace nearmiss::isolation {

// A worker starts with the following three open file descriptors.

/// On this socket, nearmiss sends a `Call`; the worker replies with the number of this call.
inline constexpr int reply_socket = 3;
inline constexpr int status_socket = 4;   ///< on this socket, the worker sends a `Status`
inline constexpr int answers_memory = 5;  ///< the shared memory with the `SharedAnswers`

/// The number of queries for which a worker always has memory. Some detectors want larger batches.
inline constexpr std::size_t least_capacity = 2048;

/// The reply to a call if the plug-in breaks the protocol, so that its answers cannot be used.
inline constexpr std::uint64_t no_reply = ~std::uint64_t{0};

/// The requests that nearmiss sends to a worker.
enum class Request : std::uint8_t {
  load,   ///< the first request: loads the plug-in
  share,  ///< the second request: maps the memory of batches (BatchMemory), whose files come with the call
  decide,
  decide_timed,  ///< decides, and measures the time of all queries together
  time_each,     ///< measures the time of each query
  bounds,        ///< gives the distance bound of each query
  distances,     ///< gives the distance of the first query's primitives
  steps,         ///< gives positions to which the vertices of the first query may safely move
};

/// A message that sends a request about a batch of queries of one kind. The number distinguishes the answers
/// to this call from the answers to earlier calls.
struct Call {
  std::uint64_t number;
  Request request;
  Kind kind = {};
  /// For the request `share`: the largest number of queries that a batch may have.
  std::uint32_t queries = 0;
};

/// A message about the plug-in's process. The first message comes from that process before it loads the
/// plug-in; the credentials of the message (unix(7)) name the process. The second message comes from the
/// supervisor when the process has ended.
struct Status {
  std::int32_t code = 0;             ///< in the second message: si_code, which says how the process ended
  std::int32_t status = 0;           ///< in the second message: si_status, the exit code or the signal
  std::int32_t is_in_namespace = 0;  ///< in the first message: 1 if the process has its own PID namespace
  /// In the second message: the end of what the process wrote to standard error. The text ends at the first
  /// zero byte.
  std::array<char, 2048> errors{};
};

/// The layout of the questions and answers of a batch of n queries in two blocks of shared memory. The layout
/// has no gaps, so a small batch uses only the start of each block. nearmiss writes the questions, which the
/// worker can only read. The worker writes the answers; the plug-in can also write to the block of the
/// answers.
struct BatchMemory {
  double* questions;
  std::byte* answers;
  std::size_t n;

  static constexpr std::size_t bytes_of_question = 25 * sizeof(double);
  static constexpr std::size_t bytes_of_answer = 5 * sizeof(std::uint64_t) + 2 * sizeof(int);

  /// The coordinates, in the layout that the detector wants.
  [[nodiscard]] double* x() const { return questions; }
  [[nodiscard]] double* separations() const { return questions + 24 * n; }

  /// For each query, the number of the call that answered it.
  [[nodiscard]] std::uint64_t* calls() const { return at<std::uint64_t>(0); }
  /// The times that Request::time_each measured.
  [[nodiscard]] std::uint64_t* nanoseconds() const { return at<std::uint64_t>(1); }
  /// For each query, the time of impact, bound, distance or clearance that the request asks for.
  [[nodiscard]] double* numbers() const { return at<double>(2); }
  /// The plug-in's decisions, with the values of nearmiss_subject.h.
  [[nodiscard]] int* values() const { return at<int>(5); }

  /// Like calls(), but for Detector::empty(), whose answers must not be mistaken for those of the plug-in.
  [[nodiscard]] std::uint64_t* calls_of_empty() const { return at<std::uint64_t>(3); }
  [[nodiscard]] double* numbers_of_empty() const { return at<double>(4); }
  [[nodiscard]] int* values_of_empty() const { return values() + n; }

 private:
  /// The start of a column: each column before it has n numbers of eight bytes.
  template <class T>
  [[nodiscard]] T* at(std::size_t column) const {
    return reinterpret_cast<T*>(answers + column * n * sizeof(std::uint64_t));
  }
};

/// The content of DetectorInfo and Contract (ccd/) as plain numbers and characters, which nearmiss can read
/// safely even if the plug-in has overwritten this memory.
struct PluginDescription {
  std::array<char, 4096> name{};  ///< the name of the detector, with its options
  std::array<char, 256> version{}, about{};
  std::array<char, most_detectors*(longest_name + 1) + 1>
      names{};  ///< the names of all detectors in the shared object, one name per line
  std::int32_t kinds = 0, is_narrow = 0, time_sort = 0, separation_kinds = 0, distance_kinds = 0,
               step_kinds = 0, in_arrays = 0, claims_bound = 0;
  std::int32_t apart_at_start = 0, one_root = 0;
  double apart_by = 0, grid = 0, shortest = 0, longest = 0;
  std::uint64_t batch = 0;
};

/// Memory that the worker writes. The plug-in, which runs in the worker's process, can write anything to it.
struct SharedAnswers {
  /// The index of the query that is being asked; if several queries are asked together, the index of the
  /// first one.
  std::atomic<std::uint32_t> current{0};
  std::atomic<std::uint32_t> calls{0};           ///< number of calls of the plug-in that were begun
  std::atomic<std::uint32_t> memory_refused{0};  ///< 1 if an allocation failed during the current query
  std::array<double, 12> more{};                 ///< weights of the closest points, or the safe positions
  std::uint64_t nanoseconds = 0;                 ///< measured by decide_timed
  /// The time without copies, as the plug-in states it; 0 if the plug-in states none.
  std::uint64_t kernel_nanoseconds = 0;
  std::array<char, 256> exception{};    ///< what() of an exception that the plug-in did not catch
  std::atomic<std::uint64_t> threw{0};  ///< the number of the last call that an exception ended
  // Written when the plug-in has been loaded:
  PluginDescription about;
  std::array<char, 1024> error{};  ///< why the plug-in cannot be used; empty if it can be used
};

static_assert(std::atomic<std::uint32_t>::is_always_lock_free &&
              std::atomic<std::uint64_t>::is_always_lock_free);

}  // namespace nearmiss::isolation
