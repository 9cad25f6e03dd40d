// Queries as inputs of libFuzzer.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>

#include "ccd/query/query.hpp"

namespace nearmiss::libfuzzer {

/// The number of bytes of an input without a separation. Such an input has one byte for the kind, then the 24
/// coordinates as they are in memory.
inline constexpr std::size_t contact_bytes = 1 + sizeof(Query::x);

/// The number of bytes of an input with a separation, which follows the coordinates. No input has more bytes.
inline constexpr std::size_t query_bytes = contact_bytes + sizeof(Query::separation);

/// The query in an input. Returns nothing if the input's size is wrong, a number is not finite, or the
/// separation is negative.
inline std::optional<Query> from_bytes(const std::uint8_t* data, std::size_t size) {
  if (size != contact_bytes && size != query_bytes) return std::nullopt;
  Query query{.kind = kinds[data[0] % kinds.size()]};
  std::memcpy(query.x.data(), data + 1, sizeof query.x);
  repeat_vertices(query);
  if (size == query_bytes) std::memcpy(&query.separation, data + contact_bytes, sizeof query.separation);
  const bool is_distance = std::isfinite(query.separation) && query.separation >= 0;
  return is_finite(query) && is_distance ? std::optional(query) : std::nullopt;
}

/// Writes a query as an input, with at most `query_bytes` bytes, and returns the size of the input.
inline std::size_t to_bytes(const Query& query, std::uint8_t* data) {
  data[0] = static_cast<std::uint8_t>(query.kind);
  std::memcpy(data + 1, query.x.data(), sizeof query.x);
  if (query.separation == 0) return contact_bytes;
  std::memcpy(data + contact_bytes, &query.separation, sizeof query.separation);
  return query_bytes;
}

}  // namespace nearmiss::libfuzzer
