// What a worker process and the process that asks it share: memory and a socket.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "ccd/query.hpp"

namespace nearmiss::isolation {

/// Descriptors with which a worker starts.
inline constexpr int socket_descriptor = 3;  ///< a byte asks for the whole batch, a byte says that it is done
inline constexpr int memory_descriptor = 4;  ///< Shared

inline constexpr std::size_t batch_size = 2048;

/// A byte that asks: decide the queries; decide them, and tell how long all took; time each by itself; give bounds.
enum class Request : char { decide = 'd', decide_timed = 't', time_each = 'e', bounds = 'b' };

/// The plug-in's answer to one query.
struct PluginAnswer {
  std::int32_t value = 0;         ///< what the plug-in returned
  std::uint64_t nanoseconds = 0;  ///< that time_each measured
  double number = 0;              ///< the time of impact, or the bound
};

/// Both sides write here, one after the other: the one that asks before a request, the worker before its
/// answer. Only `current`, `calls` and `memory_refused` are looked at meanwhile, or after the worker died.
struct Shared {
  std::atomic<std::uint32_t> current{0};         ///< the query that is being decided
  std::atomic<std::uint32_t> calls{0};           ///< of the plug-in that were begun
  std::atomic<std::uint32_t> memory_refused{0};  ///< an allocation failed while it was
  Kind kind{};
  std::uint32_t first = 0;  ///< of the batch, to be done
  std::uint32_t count = 0;  ///< up to here
  std::array<std::array<double, 24>, batch_size> queries{};
  std::array<PluginAnswer, batch_size> answers{};
  std::uint64_t nanoseconds = 0;  ///< that decide_timed measured
  // After loading, before any request:
  std::array<char, 256> name{};  ///< the plug-in's own
  bool claims_bound = false;
  std::array<char, 1024> error{};  ///< why it cannot be used; empty where it can
};

static_assert(std::atomic<std::uint32_t>::is_always_lock_free);

}  // namespace nearmiss::isolation
