#include "reports/store/store.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include "ccd/error.hpp"
#include "corpus/file.hpp"
#include "reports/store/file_lock.hpp"
#include "reports/store/run_tables.hpp"
#include "reports/store/salvage.hpp"
#include "reports/store/statistics_tables.hpp"
#include "reports/store/version.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

void make_schema(SQLite::Database& db) {
  make_contents(db);
  make_run_tables(db);
  make_statistics_tables(db);
  write_version(db);
}

/// Reads a whole store of this version. Throws Damage, or an exception of SQLite, unless it is as it was written.
Campaign read_all(SQLite::Database& db) {
  TableReader read(db);
  return {read_runs(read), read_statistics(read)};
}

/// Throws Damage if the structure of the database is damaged. That may be so although all rows can be read, but then a
/// save would do more damage.
void check_structure(SQLite::Database& db) {
  const std::string found = db.execAndGet("PRAGMA integrity_check(1)").getString();
  if (found != "ok") throw Damage(found.substr(0, found.find('\n')));
}

/// Whether a failure to read means that the file's contents are damaged, not that it cannot be opened.
bool is_damage(const std::exception& error) {
  if (dynamic_cast<const Damage*>(&error) != nullptr) return true;
  const auto* const reason = dynamic_cast<const SQLite::Exception*>(&error);
  if (reason == nullptr) return false;
  // SQLITE_ERROR: a table or a column has another name.
  return reason->getErrorCode() == SQLITE_CORRUPT || reason->getErrorCode() == SQLITE_ERROR;
}

/// The log beside a store whose writer was killed, if SQLite fails because it cannot write in its folder; otherwise "".
std::string locked_log(const fs::path& file, const std::exception& error) {
  const auto* const reason = dynamic_cast<const SQLite::Exception*>(&error);
  if (reason == nullptr) return "";
  const int code = reason->getErrorCode();
  if (code != SQLITE_CANTOPEN && code != SQLITE_READONLY) return "";
  for (const char* ending : {"-wal", "-journal"})
    if (const fs::path log = log_of(file, ending); fs::exists(log)) return log.filename().string();
  return "";
}

/// Opens a store of this version, and runs `act` with it. If it is damaged, the Error also says how much a salvage would
/// save.
template <class Act>
auto reading(const fs::path& file, const Act& act) {
  expect_regular_file(file);
  return naming(file, [&] {
    try {
      SQLite::Database db = open_to_read(file);
      const SQLite::Transaction one_save(db);  // another process may save meanwhile
      expect_version(db);
      return act(db);
    } catch (const std::exception& error) {
      if (const std::string log = locked_log(file, error); !log.empty())
        throw Error(
            fmt::format("found the log {} in a folder that cannot be written, expected write permission or "
                        "a copy of both files elsewhere",
                        log));
      if (!is_damage(error)) throw;
      throw Error(fmt::format("damaged: {}; {}", error.what(), advice(file)));
    }
  });
}

/// A connection for writing.
struct Connection {
  Connection(const fs::path& file, int flags)
      : db(file.string(), SQLite::OPEN_READWRITE | flags, patience_ms) {
    // The first page has room for the whole schema of a new file, which therefore survives if the file is cut off.
    db.exec(
        "PRAGMA page_size = 8192; PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA foreign_keys "
        "= ON;");
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection() {
    try {
      db.setBusyTimeout(patience_ms / 3);       // results are saved, and the program shall end
      db.exec("PRAGMA journal_mode = DELETE");  // leaves one plain file, for readers without write permission
    } catch (const SQLite::Exception&) {
      return;  // then the log remains next to the file, and nothing is lost
    }
  }

  SQLite::Database db;
};

/// Whether a file is an empty database.
bool is_empty_database(const fs::path& file) {
  try {
    SQLite::Database db(file.string(), SQLite::OPEN_READWRITE);  // rolls back an unfinished transaction
    return is_empty(db);
  } catch (const SQLite::Exception&) {
    return false;
  }
}

void refuse_existing(const fs::path& file) {
  if (fs::exists(file)) throw Error(fmt::format("{}: exists already, expected a new file", file.string()));
}

}  // namespace

struct Store::Database {
  explicit Database(fs::path path) : file(std::move(path)), lock(file) {}

  /// Runs `act` with the connection, in a transaction.
  template <class Act>
  void change(const Act& act) {
    naming(file, [&] {
      SQLite::Transaction transaction(connection->db);
      act(connection->db);
      transaction.commit();
    });
  }

  fs::path file;
  FileLock lock;
  std::unique_ptr<Connection> connection;
};

Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;
Store::~Store() = default;

bool Store::exists(const fs::path& file) { return fs::exists(file) && !is_empty_database(file); }

void Store::remove(const fs::path& file) {
  std::error_code ignored;
  for (const char* part : {"", "-wal", "-shm", "-journal"}) fs::remove(file.string() + part, ignored);
}

Store::Store(const fs::path& file, const RunInfo& info, const Shard& shard)
    : database_(std::make_unique<Database>(file)) {
  if (exists(file)) refuse_existing(file);
  naming(file, [&] { database_->connection = std::make_unique<Connection>(file, SQLite::OPEN_CREATE); });
  database_->change([&](SQLite::Database& db) {
    make_schema(db);
    const Run run{info, {shard}, {}};
    write_runs(db, std::span(&run, 1));
  });
}

Store::Store(const fs::path& file) : database_(std::make_unique<Database>(file)) {
  const std::vector<Run> runs = reading(file, [](SQLite::Database& db) {
    check_structure(db);
    return read_all(db).runs;
  });
  naming(file, [&] {
    if (runs.size() != 1 || runs.front().shards.size() != 1)
      throw Error("found several shards or runs, expected one to continue");
    database_->connection = std::make_unique<Connection>(file, 0);
  });
}

void Store::save(const Statistics& statistics, const Shard& shard, std::span<const Finding> new_findings) {
  database_->change([&](SQLite::Database& db) {
    write_statistics(db, statistics);
    replace_shard(db, shard);
    write_findings(db, new_findings);
  });
}

void Store::replace(std::span<const Finding> findings) {
  database_->change([&](SQLite::Database& db) { replace_findings(db, findings); });
}

void Store::add(const ScenePicture& picture) {
  database_->change([&](SQLite::Database& db) { write_picture(db, picture); });
}

Campaign load_campaign(const fs::path& file) {
  if (!fs::exists(file)) throw Error(fmt::format("{}: no such file", file.string()));
  return reading(file, read_all);
}

Campaign load_campaigns(std::span<const fs::path> files) {
  std::vector<Campaign> campaigns;
  std::vector<std::string> names;
  for (const fs::path& file : files) {
    campaigns.push_back(load_campaign(file));
    names.push_back(file.string());
  }
  return merge_campaigns(campaigns, names);
}

namespace {

void write_all(const Campaign& campaign, const fs::path& file) {
  Connection connection(file, SQLite::OPEN_CREATE);
  SQLite::Transaction transaction(connection.db);
  make_schema(connection.db);
  write_runs(connection.db, campaign.runs);
  write_statistics(connection.db, campaign.statistics);
  transaction.commit();
}

}  // namespace

void write_campaign(const Campaign& campaign, const fs::path& file) {
  refuse_existing(file);
  PartFile part(file);
  naming(file, [&] { write_all(campaign, part.path()); });
  part.put_in_place();
}

}  // namespace nearmiss
