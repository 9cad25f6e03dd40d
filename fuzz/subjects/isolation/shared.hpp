// The memory and the socket that a worker process and the asking process share.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "ccd/query.hpp"

namespace nearmiss::isolation {

/// The file descriptors with which a worker starts.
inline constexpr int socket_descriptor = 3;  ///< one byte requests a batch, one byte replies that it is done
inline constexpr int memory_descriptor = 4;  ///< Shared

inline constexpr std::size_t batch_size = 2048;

/// A request of one byte: decide the queries; decide them and measure the total time; time each query
/// separately; give bounds.
enum class Request : char { decide = 'd', decide_timed = 't', time_each = 'e', bounds = 'b' };

/// The plug-in's answer to one query.
struct PluginAnswer {
  std::int32_t value = 0;         ///< the plug-in's return value
  std::uint64_t nanoseconds = 0;  ///< measured by time_each
  double number = 0;              ///< the time of impact, or the bound
};

/// Both sides write here in turn: the asking process before a request, the worker before its reply. The
/// asking process only reads `current`, `calls` and `memory_refused` in between or after the worker died.
struct Shared {
  std::atomic<std::uint32_t> current{0};         ///< the query that is being decided
  std::atomic<std::uint32_t> calls{0};           ///< number of started calls of the plug-in
  std::atomic<std::uint32_t> memory_refused{0};  ///< 1 if an allocation failed during the current query
  Kind kind{};
  std::uint32_t first = 0;  ///< the queries [first, count) of the batch are requested
  std::uint32_t count = 0;
  std::array<std::array<double, 24>, batch_size> queries{};
  std::array<PluginAnswer, batch_size> answers{};
  std::uint64_t nanoseconds = 0;  ///< measured by decide_timed
  // Written after loading, before any request:
  std::array<char, 256> name{};  ///< the plug-in's own name
  bool claims_bound = false;
  std::array<char, 1024> error{};  ///< why the plug-in cannot be used; empty if it can
};

static_assert(std::atomic<std::uint32_t>::is_always_lock_free);

}  // namespace nearmiss::isolation
