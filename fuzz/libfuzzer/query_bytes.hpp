// Queries as inputs of libFuzzer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>

#include "ccd/query.hpp"

namespace nearmiss::libfuzzer {

/// The size of an input: one byte for the kind, then the 24 coordinates as they are in memory.
inline constexpr std::size_t query_bytes = 1 + sizeof(Query::x);

/// The query in an input; nothing if the size is wrong or a coordinate is not finite.
inline std::optional<Query> from_bytes(const std::uint8_t* data, std::size_t size) {
  if (size != query_bytes) return std::nullopt;
  Query query{.kind = kinds[data[0] % kinds.size()]};
  std::memcpy(query.x.data(), data + 1, sizeof query.x);
  return is_finite(query) ? std::optional(query) : std::nullopt;
}

/// Writes query_bytes bytes.
inline void to_bytes(const Query& query, std::uint8_t* data) {
  data[0] = static_cast<std::uint8_t>(query.kind);
  std::memcpy(data + 1, query.x.data(), sizeof query.x);
}

}  // namespace nearmiss::libfuzzer
