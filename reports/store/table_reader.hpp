// Reads a store: all of it, or its intact part.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reports/store/table.hpp"
#include "reports/store/version.hpp"

namespace nearmiss {

/// What a salvage found in one table.
struct Salvaged {
  std::string table;
  std::uint64_t intact = 0;
  std::optional<std::uint64_t> rows;  ///< nothing if their number is lost, too
};

/// Reads tables.
class TableReader {
 public:
  /// Reads everything of a store of this version, and throws Damage if something is damaged.
  explicit TableReader(SQLite::Database& db) : db_(db) {}
  /// Reads the intact rows of a store.
  static TableReader salvaging(SQLite::Database& db) {
    TableReader reader(db);
    reader.salvages_ = true;
    return reader;
  }

  /// Passes the rows of a table to `take`.
  template <class Row, class Take>
  void operator()(const Table<Row>& table, const Take& take) {
    if (!salvages_) return table.read(db_, take);
    Salvaged& result = salvaged_.emplace_back(begin(table.name));
    try {
      result.intact = table.salvage(db_, result.rows ? *result.rows : last_row(table.name), take);
    } catch (const SQLite::Exception&) {  // the table's definition is lost
    }
  }

  /// The tables that were salvaged, in the order in which they were read.
  [[nodiscard]] const std::vector<Salvaged>& salvaged() const { return salvaged_; }

 private:
  [[nodiscard]] Salvaged begin(const std::string& table);
  [[nodiscard]] std::uint64_t last_row(const std::string& table);

  SQLite::Database& db_;
  bool salvages_ = false;
  std::vector<Salvaged> salvaged_;
};

}  // namespace nearmiss
