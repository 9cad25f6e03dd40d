#include "reports/store/table.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <numeric>
#include <system_error>
#include <utility>

#include "reports/sha256.hpp"
#include "reports/text/json.hpp"

namespace nearmiss {

namespace {

using nlohmann::json;
using Take = std::function<void(const json& key, const json& value)>;
using Check = std::function<void()>;

constexpr int application_id = 0x6e656172;  // "near"
constexpr const char* contents_table = "contents";
constexpr std::array tables{"run",    "shard",  "finding",   "picture", "campaign", "counts", "oracle",
                            "funnel", "factor", "simulated", "version", "seen",     "extreme"};

/// The SQL text that defines a table, in the form in which SQLite stores it.
std::string definition(const char* table) {
  return fmt::format(
      "CREATE TABLE {} (key TEXT NOT NULL PRIMARY KEY, value TEXT NOT NULL, checksum INTEGER NOT NULL) "
      "STRICT;",
      table);
}

std::string schema() {
  std::string text = definition(contents_table);
  for (const char* table : tables) text += definition(table);
  return text;
}

/// Whether the database has a table with this name; a view is not a table. Does not let SQLite expand a view,
/// because in a hostile store this may take endless time, even if nothing reads the view.
bool is_table(SQLite::Database& db, const std::string& name) {
  const int result = sqlite3_table_column_metadata(db.getHandle(), "main", name.c_str(), nullptr, nullptr,
                                                   nullptr, nullptr, nullptr, nullptr);
  if (result != SQLITE_OK && result != SQLITE_ERROR) throw SQLite::Exception(db.getHandle(), result);
  return result == SQLITE_OK;
}

/// Whether a table exists and all its columns are plain data in the file. In a hostile store, the columns may
/// be computed: they may be generated columns, or the columns of a view over an endless recursion.
bool is_plain(SQLite::Database& db, const std::string& table) {
  if (!is_table(db, table)) return false;
  SQLite::Statement column(db, fmt::format("PRAGMA main.table_xinfo({})", table));
  for (const char* name : {"key", "value", "checksum"})
    if (!column.executeStep() || column.getColumn("name").getString() != name ||
        column.getColumn("hidden").getInt() != 0)
      return false;
  return !column.executeStep();
}

constexpr int most_bytes = 1 << 26;  // limit for a key or a value

/// The size in bytes of a database's file and of the log beside it.
std::uint64_t bytes_of(SQLite::Database& db) {
  const char* const file = sqlite3_db_filename(db.getHandle(), "main");  // without links
  std::uint64_t bytes = 0;
  for (const char* part : {file, sqlite3_filename_wal(file)}) {
    std::error_code missing;
    const std::uintmax_t size = std::filesystem::file_size(part, missing);
    if (!missing) bytes += size;
  }
  return bytes;
}

/// Limits how much of a table is read. In a hostile store, a few bytes can claim that a table has any number
/// of rows, and many rows can share one long chain of pages.
class Limits {
 public:
  explicit Limits(std::uint64_t bytes_of_store) : bytes_(bytes_of_store), unread_(bytes_of_store) {}

  /// The largest number of row ids that are looked up.
  [[nodiscard]] std::uint64_t rows() const {
    constexpr std::uint64_t least_bytes = 16;  // of a row: its checksum, lengths, key and value
    constexpr std::uint64_t most = 1'000'000;
    return std::min(bytes_ / least_bytes, most);
  }

  /// Counts the bytes of a row. Returns whether all counted rows together have at most as many bytes as the
  /// store.
  bool read(std::uint64_t bytes) {
    const bool fits = bytes <= unread_;
    unread_ -= fits ? bytes : unread_;
    return fits;
  }

  /// Counts a row that cannot be read because of damaged pages. Returns whether the reader should try another
  /// row.
  bool fail() {
    constexpr int most = 1'000;
    return ++failed_ < most;
  }

 private:
  std::uint64_t bytes_, unread_;
  int failed_ = 0;
};

/// Passes the intact rows of a plain table to `take`. Calls `check`, if given, before each row. Tries the row
/// ids from 1 to `last`. The ids have no gaps, because nearmiss removes either all rows of a table or none.
Contents read_intact(SQLite::Database& db, const std::string& table, std::uint64_t last, const Take& take,
                     const Check& check = {}) {
  Contents found;
  Limits limits(bytes_of(db));
  // Looks up each row by its id, because a damaged page would end a scan of the table, and an index may
  // itself be damaged.
  const auto where_id = [&](const char* columns) {
    return SQLite::Statement(db,
                             fmt::format("SELECT {} FROM {} NOT INDEXED WHERE rowid = ?", columns, table));
  };
  const auto has = [](SQLite::Statement& row, std::uint64_t id) {
    row.tryReset();
    row.bind(1, static_cast<std::int64_t>(id));
    return row.tryExecuteStep() == SQLITE_ROW;
  };
  SQLite::Statement row = where_id("key, value, checksum");
  SQLite::Statement only_id = where_id("rowid");
  last = std::min(last, limits.rows());
  for (std::uint64_t id = 1; id <= last; ++id) {
    if (check) check();
    if (!has(row, id)) {
      if (row.getErrorCode() == SQLITE_CORRUPT && has(only_id, id) && !limits.fail()) break;
      continue;
    }
    const std::string key = row.getColumn(0).getString();
    const std::string value = row.getColumn(1).getString();
    if (!limits.read(key.size() + value.size())) break;
    const std::int64_t sum = row.getColumn(2).getInt64();
    if (sum != checksum(table, key, value)) continue;
    found.add(static_cast<std::uint64_t>(sum));
    try {
      take(parse_json<json>(key), parse_json<json>(value));
    } catch (const std::exception& error) {
      throw Error(fmt::format("table {}: {}", table, plain_message(error)));
    }
  }
  return found;
}

ContentsByTable read_contents(SQLite::Database& db) {
  ContentsByTable contents;
  if (!is_plain(db, contents_table)) return contents;
  read_intact(db, contents_table, tables.size(),
              [&](const json& key, const json& value) { contents.emplace(key, value); });
  return contents;
}

/// The largest row id of a plain table. If the table is damaged, this may be any number.
std::uint64_t last_row(SQLite::Database& db, const std::string& table) {
  SQLite::Statement last(db, fmt::format("SELECT max(rowid) FROM {}", table));
  if (last.tryExecuteStep() != SQLITE_ROW) return 0;
  return static_cast<std::uint64_t>(std::max<std::int64_t>(last.getColumn(0).getInt64(), 0));
}

}  // namespace

std::int64_t checksum(const std::string& table, const std::string& key, const std::string& value) {
  Sha256 digest;
  digest.add(fmt::format("{} {} {} {} ", store_version, table, key.size(), value.size())).add(key).add(value);
  const auto bytes = digest.digest();
  return static_cast<std::int64_t>(
      std::accumulate(bytes.begin(), bytes.begin() + sizeof(std::uint64_t), std::uint64_t{0},
                      [](std::uint64_t first, std::uint8_t byte) { return first << 8U | byte; }));
}

bool is_empty(const SQLite::Database& db) {
  return !SQLite::Statement(db, "SELECT 1 FROM sqlite_schema").executeStep();
}

void expect_store(SQLite::Database& db) {
  if (db.execAndGet("PRAGMA application_id").getInt() != application_id)
    throw Error(is_empty(db)
                    ? "found an empty database, as a kill before the first save leaves it, expected a store "
                      "of nearmiss"
                    : "found another kind of database, expected a store of nearmiss");
  const int version = db.execAndGet("PRAGMA user_version").getInt();
  if (version != store_version)
    throw Error(fmt::format("found store version {}, expected {}", version, store_version));
  std::string found;
  SQLite::Statement definitions(db, "SELECT sql FROM sqlite_schema WHERE sql IS NOT NULL ORDER BY rowid");
  while (definitions.executeStep()) found += definitions.getColumn(0).getString() + ';';
  if (found != schema()) throw Damage("found other tables than those of a store");
}

Reader::Reader(SQLite::Database& db, Check check) : db_(db), check_(std::move(check)) {
  const auto bytes = static_cast<int>(std::min(bytes_of(db), std::uint64_t{most_bytes}));
  sqlite3_limit(db.getHandle(), SQLITE_LIMIT_LENGTH, bytes);
  try {
    contents_ = read_contents(db);
  } catch (const SQLite::Exception&) {  // the table's definition is lost
  }
}

void Reader::read(const std::string& table, const Take& take) {
  const auto contents = contents_.find(table);
  const bool is_known = contents != contents_.end();
  const Contents saved = is_known ? contents->second : Contents{};
  Contents found;
  std::uint64_t last = 0;
  try {
    if (is_plain(db_, table)) {
      last = last_row(db_, table);
      found = read_intact(db_, table, std::max(last, saved.rows), take, check_);
    }
  } catch (const SQLite::Exception&) {  // the table's definition is lost
  }
  rows_ += found.rows;
  if (!is_known)
    lost_[table] = fmt::format("an unknown number of rows of {}", table);
  else if (found.rows < saved.rows)
    lost_[table] = fmt::format("{} of {} rows of {}", saved.rows - found.rows, saved.rows, table);
  else if (found != saved || last > saved.rows)
    lost_[table] = fmt::format("the last save of {}", table);
}

Save::Save(SQLite::Database& db) : db_(db), transaction_(db, SQLite::TransactionBehavior::IMMEDIATE) {
  if (is_empty(db_)) {
    db_.exec(fmt::format("{} PRAGMA user_version = {}; PRAGMA application_id = {};", schema(), store_version,
                         application_id));
    for (const char* table : tables) contents_[table] = {};
  } else {
    contents_ = read_contents(db_);
    if (contents_.size() != tables.size()) throw Damage("the numbers of rows are lost");
  }
}

void Save::clear(const std::string& table) {
  db_.exec(fmt::format("DELETE FROM {}", table));
  contents_.at(table) = {};
}

void Save::commit() {
  insert(contents_table, rows_of(contents_), {}, true);
  transaction_.commit();
}

Contents Save::insert(const std::string& table, const Rows& rows, Contents contents, bool replaces) {
  const char* const on_conflict =
      "ON CONFLICT DO UPDATE SET value = excluded.value, checksum = excluded.checksum "
      "WHERE checksum <> excluded.checksum";
  SQLite::Statement insert(
      db_, fmt::format("INSERT INTO {} VALUES (?, ?, ?) {}", table, replaces ? on_conflict : ""));
  for (const auto& [key, value] : rows) {
    const std::int64_t sum = checksum(table, key, value);
    insert.bindNoCopy(1, key);
    insert.bindNoCopy(2, value);
    insert.bind(3, sum);
    insert.exec();
    insert.reset();
    contents.add(static_cast<std::uint64_t>(sum));
  }
  return contents;
}

}  // namespace nearmiss
