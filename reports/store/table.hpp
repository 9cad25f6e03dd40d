// A table of the store. Each column is declared once, with its name and the member of a row that it stores.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "reports/statistics/counter.hpp"
#include "reports/store/contents.hpp"
#include "reports/store/values.hpp"

namespace nearmiss {

/// A column of a table with rows of type Row.
template <class Row>
struct Column {
  std::string name;
  std::string type;
  std::function<Value(Row&)> get;
  std::function<void(const SQLite::Column&, Value&)> read;
  std::function<void(const Value&, Row&)> set;
};

/// Declares a column. `member_of(row)` is a reference to the member of the row that the column stores.
template <class Row, class MemberOf>
Column<Row> column(std::string name, const MemberOf& member_of) {
  using Stored = decltype(to_stored(member_of(std::declval<Row&>())));
  const char* const type = std::is_same_v<Stored, std::int64_t> ? "INTEGER"
                           : std::is_same_v<Stored, double>     ? "REAL"
                                                                : "TEXT";
  const std::string place = "column " + name;
  return {std::move(name), type, [member_of](Row& row) -> Value { return to_stored(member_of(row)); },
          [](const SQLite::Column& stored, Value& value) {
            if constexpr (std::is_same_v<Stored, std::int64_t>)
              value = stored.getInt64();
            else if constexpr (std::is_same_v<Stored, double>)
              value = stored.getDouble();
            else
              value = stored.getString();
          },
          [member_of, place](const Value& value, Row& row) {
            from_stored(std::get<Stored>(value), member_of(row), place);
          }};
}

/// Declares a column for each counter of `Owner`. `owner_of(row)` is a reference to the counters of the row.
template <class Row, class Owner, class OwnerOf>
void add_counters(std::vector<Column<Row>>& columns, const std::string& prefix, const OwnerOf& owner_of) {
  for_each_counter<Owner>([&](const auto& counter) {
    const auto member_of = [ owner_of, member = counter.member ](Row & row) -> auto& {
      return owner_of(row).*member;
    };
    using Member = std::remove_cvref_t<decltype(member_of(std::declval<Row&>()))>;
    const std::string name = prefix + std::string(counter.name);
    if constexpr (requires { Member::counters(); })
      add_counters<Row, Member>(columns, name + "_", member_of);
    else
      columns.push_back(column<Row>(name, member_of));
  });
}

/// A row as it is stored.
struct StoredRow {
  std::vector<Value> values;
  std::uint64_t found = 0, expected = 0;  ///< checksum of the values, and the one stored with them
};

/// A table. Single rows are never removed, so the ids of n rows are between 0 and n.
template <class Row>
struct Table {
  std::string name;
  std::string constraint;          ///< "" or a constraint of the table
  std::vector<std::string> order;  ///< columns that give the order in which rows are read, if it matters
  std::vector<Column<Row>> columns;

  void make(SQLite::Database& db) const {
    std::vector<std::string> definitions;
    for (const auto& each : columns)
      definitions.push_back(fmt::format("\"{}\" {} NOT NULL", each.name, each.type));
    definitions.emplace_back("checksum INTEGER NOT NULL");
    if (!constraint.empty()) definitions.push_back(constraint);
    db.exec(fmt::format("CREATE TABLE {} ({}) STRICT", name, fmt::join(definitions, ", ")));
    write_contents(db, name, {});
  }

  /// Adds rows. Throws SQLite::Exception if the table has one of them.
  void add(SQLite::Database& db, std::vector<Row> rows) const {
    if (rows.empty()) return;
    Contents contents = read_contents(db, name);
    insert(db, rows, "", contents);
    write_contents(db, name, contents);
  }

  /// Removes all rows.
  void clear(SQLite::Database& db) const {
    db.exec(fmt::format("DELETE FROM {}", name));
    write_contents(db, name, {});
  }

  /// Replaces the whole contents by rows with the same keys, and possibly more. Writes only rows that have changed.
  void replace(SQLite::Database& db, std::vector<Row> rows) const {
    std::vector<std::string> sets{"checksum = excluded.checksum"};
    for (const auto& each : columns) sets.push_back(fmt::format("\"{0}\" = excluded.\"{0}\"", each.name));
    Contents contents;
    insert(db, rows,
           fmt::format("ON CONFLICT DO UPDATE SET {} WHERE checksum <> excluded.checksum",
                       fmt::join(sets, ", ")),
           contents);
    write_contents(db, name, contents);
  }

  /// Passes every row to `take`. Throws Damage if a row is not as it was written, or if rows are missing.
  void read(SQLite::Database& db, const std::function<void(Row&&)>& take) const {
    const Contents expected = read_contents(db, name);
    Contents found;
    // No index is used: it may be damaged where the rows are intact. `+` and NOT INDEXED forbid it.
    std::string by;
    for (const std::string& each : order)
      by += fmt::format("{} +\"{}\"", by.empty() ? "ORDER BY" : ",", each);
    SQLite::Statement rows(db, fmt::format("SELECT {} FROM {} NOT INDEXED {}", selected(), name, by));
    while (rows.executeStep()) {
      const StoredRow row = stored(rows);
      if (row.found != row.expected)
        throw Damage(fmt::format("a row of table {} does not match its checksum", name));
      found.add(row.found);
      take(made(row));
    }
    if (found.rows != expected.rows)
      throw Damage(fmt::format("found {} rows of table {}, expected {}", found.rows, name, expected.rows));
    if (found != expected)
      throw Damage(fmt::format("the rows of table {} are not those of the last save", name));
  }

  /// Passes every intact row to `take`, each once. `most` is the largest row id that is tried.
  std::uint64_t salvage(SQLite::Database& db, std::uint64_t most,
                        const std::function<void(Row&&)>& take) const {
    std::set<std::uint64_t> taken;
    // Each row is looked up on its own, because a damaged page ends a scan of the table.
    SQLite::Statement row(db, fmt::format("SELECT {} FROM {} NOT INDEXED WHERE rowid = ?", selected(), name));
    for (std::uint64_t id = 0; id <= most; ++id) {
      row.tryReset();
      row.bind(1, static_cast<std::int64_t>(id));
      if (row.tryExecuteStep() != SQLITE_ROW) continue;
      const StoredRow found = stored(row);
      if (found.found == found.expected && taken.insert(found.found).second) take(made(found));
    }
    return taken.size();
  }

 private:
  [[nodiscard]] std::string selected() const {
    std::string list;
    for (const auto& each : columns) list += fmt::format("\"{}\", ", each.name);
    return list + "checksum";
  }

  /// Inserts rows, and adds them to `contents`.
  void insert(SQLite::Database& db, std::vector<Row>& rows, const std::string& on_conflict,
              Contents& contents) const {
    SQLite::Statement statement(
        db, fmt::format("INSERT INTO {} ({}) VALUES ({}?) {}", name, selected(),
                        fmt::join(std::vector<std::string>(columns.size(), "?, "), ""), on_conflict));
    std::vector<Value> values(columns.size());
    for (Row& row : rows) {
      for (std::size_t i = 0; i < columns.size(); ++i) {
        values[i] = columns[i].get(row);
        std::visit([&](const auto& value) { statement.bind(static_cast<int>(i) + 1, value); }, values[i]);
      }
      const std::uint64_t sum = checksum(name, values);
      statement.bind(static_cast<int>(columns.size()) + 1, static_cast<std::int64_t>(sum));
      statement.exec();
      statement.reset();
      contents.add(sum);
    }
  }

  [[nodiscard]] StoredRow stored(SQLite::Statement& rows) const {
    StoredRow row{std::vector<Value>(columns.size())};
    for (std::size_t i = 0; i < columns.size(); ++i)
      columns[i].read(rows.getColumn(static_cast<int>(i)), row.values[i]);
    row.found = checksum(name, row.values);
    row.expected = static_cast<std::uint64_t>(rows.getColumn(static_cast<int>(columns.size())).getInt64());
    return row;
  }

  [[nodiscard]] Row made(const StoredRow& stored_row) const {
    Row row;
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i].set(stored_row.values[i], row);
    return row;
  }
};

}  // namespace nearmiss
