// Reads a store: all of it, or its intact part.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reports/store/table.hpp"

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
  /// Reads everything and throws Damage, or, if `salvages`, reads the intact rows.
  TableReader(SQLite::Database& db, bool salvages) : db_(db), salvages_(salvages) {}

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
  bool salvages_;
  std::vector<Salvaged> salvaged_;
};

}  // namespace nearmiss
