// Memory and sockets that a worker process shares with nearmiss.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "ccd/query/query.hpp"
#include "ccd/subjects/detector.hpp"

namespace nearmiss::isolation {

/// File descriptors with which a worker starts.
inline constexpr int reply_socket = 3;   ///< a `Call` requests a batch; its number is the reply
inline constexpr int status_socket = 4;  ///< a `Status` for each change
inline constexpr int questions_memory = 5;
inline constexpr int answers_memory = 6;

inline constexpr std::size_t batch_size = 2048;

/// A reply to a call whose answers cannot be used, because the plug-in breaks the protocol.
inline constexpr std::uint64_t no_reply = ~std::uint64_t{0};

/// What a worker does with the queries of a batch.
enum class Request : std::uint8_t {
  load,  ///< loads the plug-in; comes first
  decide,
  decide_timed,  ///< decides, and measures the time of all queries together
  time_each,     ///< measures the time of each query
  bounds,        ///< gives the distance bound of each query
};

/// A message that requests something. The number distinguishes its answers from those of earlier calls.
struct Call {
  std::uint64_t number;
  Request request;
};

/// A message about the plug-in's process. The first one comes from that process before it loads the plug-in,
/// and its credentials (unix(7)) name the process; the other one comes from the supervisor when the process
/// has ended.
struct Status {
  std::int32_t code;             ///< si_code when it has ended, else 0
  std::int32_t status;           ///< si_status
  std::int32_t is_in_namespace;  ///< in the first message: 1 if the process is in a PID namespace of its own
};

/// Written by nearmiss. The worker can only read it.
struct SharedQuestions {
  Kind kind{};
  std::uint32_t first = 0;  ///< the request is about the queries [first, last)
  std::uint32_t last = 0;
  std::array<std::array<double, 24>, batch_size> queries{};
  std::array<double, batch_size> separations{};
};

/// DetectorInfo and Contract (ccd/) as plain numbers, which can be read whatever the plug-in wrote.
struct PluginDescription {
  std::array<char, 4096> name{};  ///< of the detector, with its options
  std::array<char, 256> version{}, about{};
  std::array<char, most_detectors*(longest_name + 1) + 1>
      names{};  ///< of all detectors in the shared object, a line each
  std::int32_t kinds = 0, is_narrow = 0, time_sort = 0, separation_kinds = 0, claims_bound = 0;
  std::int32_t apart_at_start = 0, one_root = 0;
  double apart_by = 0, grid = 0, shortest = 0, longest = 0;
  std::uint64_t batch = 0;
};

/// The plug-in's answer to one query.
struct PluginAnswer {
  std::uint64_t call = 0;         ///< the call that it answers
  std::uint64_t nanoseconds = 0;  ///< measured by time_each
  double number = 0;              ///< the time of impact, or the bound
  std::int32_t value = 0;         ///< the plug-in's return value
};

/// Written by the worker. The plug-in runs in the same process, and can write anything here.
struct SharedAnswers {
  std::atomic<std::uint32_t> current{0};         ///< the query that is being decided, or the first of several
  std::atomic<std::uint32_t> calls{0};           ///< number of calls of the plug-in that were begun
  std::atomic<std::uint32_t> memory_refused{0};  ///< 1 if an allocation failed during the current query
  std::array<PluginAnswer, batch_size> of{};
  std::uint64_t nanoseconds = 0;        ///< measured by decide_timed
  std::array<char, 256> exception{};    ///< what() of an exception that the plug-in did not catch
  std::atomic<std::uint64_t> threw{0};  ///< the last call that an exception ended, at the query `current`
  // Written after loading, before any request:
  PluginDescription about;
  std::array<char, 1024> error{};  ///< why the plug-in cannot be used; empty if it can
};

static_assert(std::atomic<std::uint32_t>::is_always_lock_free &&
              std::atomic<std::uint64_t>::is_always_lock_free);

}  // namespace nearmiss::isolation
