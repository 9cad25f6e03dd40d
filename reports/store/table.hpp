// The tables of a store. Each table is a map: a row has a key and a value, which are JSON, and a checksum.
// SQLite trusts what it reads from a file, so without checksums a flipped bit would change a number
// unnoticed.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ccd/query/error.hpp"
#include "reports/store/values.hpp"
#include "reports/text/json.hpp"

namespace nearmiss {

/// The version of the tables and of their contents. Only stores of this version are read. Every change of the
/// tables or contents raises the version, unless it only adds a member that rows may lack.
inline constexpr int store_version = 25;

/// Thrown if a store is not as it was written. The message says which part is damaged.
class Damage : public Error {
 public:
  using Error::Error;
};

/// Whether a database has no tables. A kill before the first save leaves such a file.
bool is_empty(const SQLite::Database& db);

/// Throws Error if the database is not a store of this version. Throws Damage if it lacks a table of a
/// store, or has anything else, such as a view or a trigger.
void expect_store(SQLite::Database& db);

/// The checksum of a row: the first 64 bits of a SHA-256 digest of the version, the table's name, the key and
/// the value.
std::int64_t checksum(const std::string& table, const std::string& key, const std::string& value);

/// The number of rows of a table, and the sum of the rows' checksums modulo 2^64. These two numbers reveal
/// rows that are missing, doubled, or left from an earlier save. The table `contents` has the two numbers for
/// every other table. A save updates them without reading the rows that it does not change.
struct Contents {
  std::uint64_t rows = 0, sum = 0;

  void add(std::uint64_t row_checksum) {
    ++rows;
    sum += row_checksum;
  }
  bool operator==(const Contents&) const = default;
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Contents, rows, sum)

using ContentsByTable = std::map<std::string, Contents>;

/// Reads the intact rows of a store, which are the rows that match their checksums, and notes how many rows
/// are lost.
class Reader {
 public:
  /// The reader calls `check`, if given, before it reads a row. `check` may end the reading by an exception.
  explicit Reader(SQLite::Database& db, std::function<void()> check = {});

  /// Puts the intact rows of a table into a map. Throws Error for a value that this version does not know.
  template <class Map>
  void operator()(const std::string& table, Map& map) {
    read(table, [&](const nlohmann::json& key, const nlohmann::json& value) {
      map.emplace(key.get<typename Map::key_type>(), value.get<typename Map::mapped_type>());
    });
  }

  /// The number of rows that were read.
  [[nodiscard]] std::uint64_t rows() const { return rows_; }
  /// For each table with losses, a text that says what was lost, such as "3 of 20 rows of counts".
  [[nodiscard]] const std::map<std::string, std::string>& lost() const { return lost_; }

 private:
  void read(const std::string& table,
            const std::function<void(const nlohmann::json& key, const nlohmann::json& value)>& take);

  SQLite::Database& db_;
  std::function<void()> check_;
  ContentsByTable contents_;
  std::uint64_t rows_ = 0;
  std::map<std::string, std::string> lost_;
};

/// Changes a store in one transaction. `commit` ends the transaction; without a call of `commit`, nothing
/// changes.
class Save {
 public:
  /// Makes the tables if the database is empty. Throws Damage if the table of contents is damaged.
  explicit Save(SQLite::Database& db);

  /// Replaces the rows of a table by the entries of a map. The map must have all keys of the table, and may
  /// have more. Writes only rows that have changed.
  template <class Map>
  void replace(const std::string& table, const Map& map) {
    contents_.at(table) = insert(table, rows_of(map), {}, true);
  }

  /// Adds the entries of a map as rows; the keys must be new.
  template <class Map>
  void add(const std::string& table, const Map& map) {
    contents_.at(table) = insert(table, rows_of(map), contents_.at(table), false);
  }

  void clear(const std::string& table);

  [[nodiscard]] std::uint64_t rows(const std::string& table) const { return contents_.at(table).rows; }

  void commit();

 private:
  using Rows = std::vector<std::pair<std::string, std::string>>;

  template <class Map>
  static Rows rows_of(const Map& map) {
    Rows rows;
    for (const auto& [key, value] : map)
      rows.emplace_back(json_text(nlohmann::json(key)), json_text(nlohmann::json(value)));
    return rows;
  }

  /// Inserts rows. Returns `contents` with these rows added.
  Contents insert(const std::string& table, const Rows& rows, Contents contents, bool replaces);

  SQLite::Database& db_;
  SQLite::Transaction transaction_;
  ContentsByTable contents_;
};

}  // namespace nearmiss
