// A table of the store. Each column is declared once, with its name and the member of a row that it stores.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "reports/statistics/counter.hpp"
#include "reports/store/values.hpp"

namespace nearmiss {

/// A column of a table with rows of type Row.
template <class Row>
struct Column {
  std::string name;
  std::string type;
  std::function<void(SQLite::Statement&, const std::string& parameter, Row&)> write;
  std::function<void(const SQLite::Column&, Row&)> read;
};

/// Declares a column. `member_of(row)` is a reference to the member of the row that the column stores.
template <class Row, class MemberOf>
Column<Row> column(std::string name, const MemberOf& member_of) {
  using Stored = decltype(to_stored(member_of(std::declval<Row&>())));
  const char* const type = std::is_same_v<Stored, std::int64_t> ? "INTEGER"
                           : std::is_same_v<Stored, double>     ? "REAL"
                                                                : "TEXT";
  const std::string place = "column " + name;
  return {std::move(name), type,
          [member_of](SQLite::Statement& statement, const std::string& parameter, Row& row) {
            statement.bind(parameter, to_stored(member_of(row)));
          },
          [member_of, place](const SQLite::Column& stored, Row& row) {
            if constexpr (std::is_same_v<Stored, std::int64_t>)
              from_stored(stored.getInt64(), member_of(row), place);
            else if constexpr (std::is_same_v<Stored, double>)
              from_stored(stored.getDouble(), member_of(row), place);
            else
              from_stored(stored.getString(), member_of(row), place);
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

template <class Row>
struct Table {
  std::string name;
  std::string constraint;  ///< "" or a constraint of the table
  std::string order;       ///< order of the rows when they are read
  std::vector<Column<Row>> columns;

  void make(SQLite::Database& db) const {
    std::vector<std::string> definitions;
    for (const auto& each : columns)
      definitions.push_back(fmt::format("\"{}\" {} NOT NULL", each.name, each.type));
    if (!constraint.empty()) definitions.push_back(constraint);
    db.exec(fmt::format("CREATE TABLE {} ({}) STRICT", name, fmt::join(definitions, ", ")));
  }

  /// Adds rows, or replaces those with the same primary key.
  void write(SQLite::Database& db, std::vector<Row> rows) const {
    std::vector<std::string> names;
    std::vector<std::string> parameters;
    for (const auto& each : columns) {
      names.push_back(fmt::format("\"{}\"", each.name));
      parameters.push_back(":" + each.name);
    }
    SQLite::Statement insert(db, fmt::format("INSERT OR REPLACE INTO {} ({}) VALUES ({})", name,
                                             fmt::join(names, ", "), fmt::join(parameters, ", ")));
    for (Row& row : rows) {
      for (std::size_t i = 0; i < columns.size(); ++i) columns[i].write(insert, parameters[i], row);
      insert.exec();
      insert.reset();
    }
  }

  /// Passes every row to `take`.
  void read(SQLite::Database& db, const std::function<void(Row&&)>& take) const {
    SQLite::Statement rows(db, fmt::format("SELECT * FROM {} ORDER BY {}", name, order));
    while (rows.executeStep()) {
      Row row;
      for (const auto& each : columns) each.read(rows.getColumn(each.name.c_str()), row);
      take(std::move(row));
    }
  }
};

}  // namespace nearmiss
