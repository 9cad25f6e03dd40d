#include "fuzz/libfuzzer/store_mutation.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "ccd/query/error.hpp"
#include "reports/store/table.hpp"
#include "reports/text/json.hpp"
#include "reports/text/json_file.hpp"

namespace nearmiss::libfuzzer {

namespace {

using nlohmann::json;

template <class Container>
auto& one_of(Random& random, Container& container) {
  return container[random.bits() % container.size()];
}

std::uint64_t any_size(Random& random) { return random.bits() >> random.integer(0, 63); }

// --- JSON ------------------------------------------------------------------------------------------------

json any_value(Random& random) {
  static const json values = {
      nullptr, true, 0,          -1,     1,     1.5,    -0.0,    1e308,         5e-324,
      "",      "\n", "\x1b[31m", "../x", "nan", "-inf", "1e999", json::array(), json::object()};
  static const auto highest = std::numeric_limits<std::uint64_t>::max();
  switch (random.integer(0, 9)) {
    case 0:
      return any_size(random);
    case 1:
      return highest >> random.integer(0, 1);
    case 2:
      return -static_cast<std::int64_t>(any_size(random) >> 1U);
    case 3:
      return std::string(static_cast<std::size_t>(random.integer(0, 3000)), random.one_in(2) ? 'x' : '\0');
    default:
      return one_of(random, values);
  }
}

void collect(json& node, std::vector<json*>& nodes) {
  nodes.push_back(&node);
  if (node.is_structured())
    for (json& each : node) collect(each, nodes);
}

/// Changes the length of an array or object.
void lengthen_or_shorten(json& node, Random& random, const json& other) {
  const bool shorten = !node.empty() && random.one_in(2);
  const auto place = node.empty()
                         ? node.end()
                         : std::next(node.begin(), random.integer(0, static_cast<int>(node.size()) - 1));
  if (shorten)
    node.erase(place);
  else if (node.is_array())
    node.insert(place, static_cast<std::size_t>(random.one_in(8) ? 300 : 1),
                node.empty() || random.one_in(4) ? other : *place);
  else if (other.is_string())
    node[other.get<std::string>()] = any_value(random);
}

/// Changes one node of a JSON value.
void change_node(json& whole, Random& random, const MutateBytes& mutate_bytes) {
  std::vector<json*> nodes;
  collect(whole, nodes);
  json& node = *one_of(random, nodes);
  const json other = *one_of(random, nodes);
  if (random.one_in(5))
    node = any_value(random);
  else if (random.one_in(5))
    node = other;
  else if (node.is_structured())
    lengthen_or_shorten(node, random, other);
  else if (node.is_string())
    node = mutate_bytes(node.get<std::string>());
  else if (node.is_number_unsigned())
    node = random.one_in(2) ? node.get<std::uint64_t>() + 1 : any_size(random);
  else
    node = any_value(random);
}

std::string mutated_json(std::string_view text, Random& random, const MutateBytes& mutate_bytes) {
  json value;
  try {
    value = parse_json<json>(text);
  } catch (const Error&) {
    return mutate_bytes(text);
  }
  if (random.one_in(10)) return mutate_bytes(text);
  do change_node(value, random, mutate_bytes);
  while (random.one_in(3));
  if (random.one_in(100))
    for (int level = 0; level < 40; ++level) value = json::array({std::move(value)});
  return value.dump(-1, ' ', false, json::error_handler_t::ignore);
}

// --- SQL -------------------------------------------------------------------------------------------------

// While a store is changed, its tables accept any value in each column.
constexpr const char* strict_columns =
    " (key TEXT NOT NULL PRIMARY KEY, value TEXT NOT NULL, checksum INTEGER NOT NULL) STRICT";
constexpr const char* loose_columns = " (key PRIMARY KEY, value, checksum)";

/// Changes of rows: {t} and {u} are tables, {r} is the id of a row of {t}, {n} a number.
constexpr std::array row_changes{
    "DELETE FROM {t} WHERE rowid = {r}",
    "DELETE FROM {t}",
    "UPDATE {t} SET rowid = {n} WHERE rowid = {r}",
    "INSERT INTO {t} SELECT key || ' ', value, checksum FROM {t} WHERE rowid = {r}",
    "INSERT OR IGNORE INTO {t} SELECT * FROM {u} LIMIT 3",
    "UPDATE {t} SET value = (SELECT value FROM {u} LIMIT 1) WHERE rowid = {r}",
    "UPDATE {t} SET key = (SELECT key FROM {u} LIMIT 1) WHERE rowid = {r}",
    "UPDATE {t} SET value = NULL WHERE rowid = {r}",
    "UPDATE {t} SET value = {n} WHERE rowid = {r}",
    "UPDATE {t} SET value = -9e999 WHERE rowid = {r}",
    "UPDATE {t} SET value = CAST(value AS BLOB), key = CAST(key AS BLOB) WHERE rowid = {r}",
    "UPDATE {t} SET value = zeroblob({n} % 100000) WHERE rowid = {r}",
    "UPDATE {t} SET value = '\"' || hex(zeroblob({n} % 20000)) || '\"' WHERE rowid = {r}"};

/// Changes of tables. After most of these changes, only a salvage can read the store.
constexpr std::array table_changes{
    "PRAGMA user_version = {n}",
    "PRAGMA application_id = {n}",
    "ALTER TABLE {t} RENAME COLUMN value TO v",
    "ALTER TABLE {t} DROP COLUMN value",
    "ALTER TABLE {t} ADD COLUMN more",
    "ALTER TABLE {t} RENAME TO other",
    "DROP TABLE {t}",
    "CREATE INDEX i{n} ON {t} (value)",
    "CREATE VIEW v{n} AS SELECT * FROM {t}",
    "CREATE TRIGGER t{n} INSERT ON {t} BEGIN DELETE FROM {u}; END",
    "DROP TABLE {t}; CREATE VIEW {t} AS SELECT rowid AS rowid, * FROM {u}",
    "DROP TABLE {t}; CREATE VIEW {t} AS WITH RECURSIVE r(n) AS (SELECT 1 UNION ALL SELECT n FROM r) SELECT n "
    "AS rowid, n AS key, n AS value, n AS checksum FROM r",
    "DROP TABLE {t}; CREATE TABLE {t} (key, value TEXT AS (zeroblob(60000000)), checksum); INSERT INTO {t} "
    "(key) SELECT key FROM {u}",
    "DROP TABLE {t}; CREATE TABLE {t} (key, value, checksum, rowid AS (1))",
    "DROP TABLE {t}; CREATE TABLE {t} (key PRIMARY KEY, value, checksum) WITHOUT ROWID",
    "DROP TABLE {t}; CREATE VIRTUAL TABLE {t} USING fts5 (key, value, checksum)",
    "PRAGMA page_size = 1024; VACUUM",
    "PRAGMA auto_vacuum = 1; VACUUM"};

/// A store in memory, while it is changed.
class OpenStore {
 public:
  explicit OpenStore(std::string_view store) : db_(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE) {
    auto* const bytes = static_cast<unsigned char*>(sqlite3_malloc64(store.size() + 1));
    std::memcpy(bytes, store.data(), store.size());
    const auto size = static_cast<sqlite3_int64>(store.size());
    sqlite3_deserialize(db_.getHandle(), "main", bytes, size, size,
                        SQLITE_DESERIALIZE_FREEONCLOSE | SQLITE_DESERIALIZE_RESIZEABLE);
    // A store may define views or columns that take endless time to read, or that fill the memory.
    constexpr int most_instructions = 100'000;
    constexpr int most_bytes = 1 << 20;
    sqlite3_progress_handler(
        db_.getHandle(), most_instructions, [](void*) { return 1; }, nullptr);
    sqlite3_limit(db_.getHandle(), SQLITE_LIMIT_LENGTH, most_bytes);
    redefine(strict_columns, loose_columns);
  }

  void change_cell(Random& random, const MutateBytes& mutate_bytes) {
    const std::string table = some_table(random);
    const std::int64_t row = some_row(random, table);
    const char* const column = random.one_in(4) ? "key" : "value";
    SQLite::Statement cell(db_, fmt::format("SELECT {} FROM \"{}\" WHERE rowid = {}", column, table, row));
    if (!cell.executeStep()) return;
    SQLite::Statement update(db_,
                             fmt::format("UPDATE \"{}\" SET {} = ? WHERE rowid = {}", table, column, row));
    update.bind(1, mutated_json(cell.getColumn(0).getString(), random, mutate_bytes));
    cell.reset();
    update.exec();
  }

  template <class Changes>
  void change(const Changes& changes, Random& random) {
    const std::string table = some_table(random);
    db_.exec(fmt::format(fmt::runtime(one_of(random, changes)), fmt::arg("t", table),
                         fmt::arg("u", some_table(random)), fmt::arg("r", some_row(random, table)),
                         fmt::arg("n", any_size(random) >> 1U)));
  }

  /// Corrects the checksums of all rows and, if `counts_rows`, also the recorded numbers of rows.
  void seal(bool counts_rows) {
    std::vector<std::string> names = tables();
    for (const std::string& table : names) {
      if (table == "contents") continue;
      const Contents contents = seal_rows(table);
      if (!counts_rows) continue;
      SQLite::Statement replace(
          db_, "INSERT INTO contents VALUES (?, ?, 0) ON CONFLICT DO UPDATE SET value = excluded.value");
      replace.bind(1, json(table).dump());
      replace.bind(2, json(contents).dump());
      replace.exec();
    }
    seal_rows("contents");
  }

  std::string bytes() {
    redefine(loose_columns, strict_columns);
    sqlite3_int64 size = 0;
    auto* const copy = sqlite3_serialize(db_.getHandle(), "main", &size, 0);
    if (copy == nullptr) return "";
    std::string store(reinterpret_cast<const char*>(copy), static_cast<std::size_t>(size));
    sqlite3_free(copy);
    return store;
  }

 private:
  void redefine(const char* before, const char* after) {
    db_.exec("PRAGMA writable_schema = ON");
    SQLite::Statement update(db_, "UPDATE sqlite_schema SET sql = replace(sql, ?, ?) WHERE type = 'table'");
    update.bind(1, before);
    update.bind(2, after);
    update.exec();
    db_.exec("PRAGMA writable_schema = RESET");
  }

  std::vector<std::string> tables() {
    std::vector<std::string> names;
    SQLite::Statement each(
        db_, "SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT GLOB '*[^a-z]*'");
    while (each.executeStep()) names.push_back(each.getColumn(0).getString());
    return names;
  }

  /// A table, mostly one that has rows.
  std::string some_table(Random& random) {
    std::vector<std::string> names = tables();
    if (!random.one_in(10))
      std::erase_if(names, [&](const std::string& table) { return rows(table).empty(); });
    return names.empty() ? "run" : one_of(random, names);
  }

  /// The ids of the first rows, as far as they can be read.
  std::vector<std::int64_t> rows(const std::string& table) {
    std::vector<std::int64_t> ids;
    SQLite::Statement each(db_, fmt::format("SELECT rowid FROM \"{}\" LIMIT 100", table));
    while (each.tryExecuteStep() == SQLITE_ROW) ids.push_back(each.getColumn(0).getInt64());
    return ids;
  }

  /// The id of a row; 1 if the table has none.
  std::int64_t some_row(Random& random, const std::string& table) {
    const std::vector<std::int64_t> ids = rows(table);
    return ids.empty() ? 1 : one_of(random, ids);
  }

  Contents seal_rows(const std::string& table) {
    Contents contents;
    SQLite::Statement row(db_, fmt::format("SELECT rowid, key, value FROM \"{}\"", table));
    std::vector<std::pair<std::int64_t, std::int64_t>> sums;
    while (row.executeStep())
      sums.emplace_back(row.getColumn(0).getInt64(),
                        checksum(table, row.getColumn(1).getString(), row.getColumn(2).getString()));
    SQLite::Statement update(db_, fmt::format("UPDATE \"{}\" SET checksum = ? WHERE rowid = ?", table));
    for (const auto& [id, sum] : sums) {
      update.bind(1, sum);
      update.bind(2, id);
      update.exec();
      update.reset();
      contents.add(static_cast<std::uint64_t>(sum));
    }
    return contents;
  }

  SQLite::Database db_;
};

}  // namespace

std::string mutated_store(Random& random, std::string_view store, const MutateBytes& mutate_bytes) {
  if (random.one_in(16)) return mutate_bytes(store);
  try {
    OpenStore open(store);
    do {
      if (random.one_in(20))
        open.change(table_changes, random);
      else if (random.one_in(6))
        open.change(row_changes, random);
      else
        open.change_cell(random, mutate_bytes);
    } while (random.one_in(3));
    if (!random.one_in(16)) open.seal(!random.one_in(8));
    return open.bytes();
  } catch (const SQLite::Exception&) {
    return mutate_bytes(store);
  }
}

}  // namespace nearmiss::libfuzzer
