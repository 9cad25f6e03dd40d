#include "reports/store/table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace nearmiss {

Salvaged TableReader::begin(const std::string& table) {
  try {
    return {table, 0, read_contents(db_, table).rows};
  } catch (const std::exception&) {
    return {table, 0, std::nullopt};
  }
}

std::uint64_t TableReader::last_row(const std::string& table) {
  constexpr std::int64_t most = 10'000'000;  // a damaged row id can have any size
  const std::int64_t last =
      db_.execAndGet(fmt::format("SELECT ifnull(max(rowid), 0) FROM {}", table)).getInt64();
  return static_cast<std::uint64_t>(std::clamp<std::int64_t>(last, 0, most));
}

}  // namespace nearmiss
