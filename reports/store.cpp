#include "reports/store.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include "ccd/error.hpp"
#include "reports/file_lock.hpp"
#include "reports/store_rows.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

constexpr int application_id = 0x6e656172;  // "near"

void make_schema(SQLite::Database& db) {
  make_tables(db);
  db.exec(
      fmt::format("PRAGMA user_version = {}; PRAGMA application_id = {};", schema_version, application_id));
}

/// Throws Error where it is no store, or one of another version.
void check_version(SQLite::Database& db, const std::string& where) {
  if (db.execAndGet("PRAGMA application_id").getInt() != application_id)
    throw Error(fmt::format("{}: found another kind of database, expected a store of nearmiss", where));
  const int version = db.execAndGet("PRAGMA user_version").getInt();
  if (version != schema_version)
    throw Error(fmt::format("{}: found store version {}, expected {}", where, version, schema_version));
}

[[noreturn]] void fail(const fs::path& file, const std::exception& error) {
  throw Error(fmt::format("{}: {}", file.string(), error.what()));
}

/// A connection for writing.
struct Connection {
  Connection(const fs::path& file, int flags) : db(file.string(), SQLite::OPEN_READWRITE | flags) {
    db.exec("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON;");
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection() {
    try {
      db.exec("PRAGMA journal_mode = DELETE");  // one plain file is left, for readers that may not write
    } catch (const SQLite::Exception&) {
      return;  // then the log stays beside it, and nothing is lost
    }
  }

  SQLite::Database db;
};

/// Whether a file is a database without tables, which a kill during the creation of a store leaves.
bool is_empty_database(const fs::path& file) {
  try {
    SQLite::Database db(file.string(), SQLite::OPEN_READWRITE);  // rolls back an unfinished transaction
    return db.execAndGet("SELECT count(*) FROM sqlite_schema").getInt() == 0;
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

  fs::path file;
  FileLock lock;
  std::int64_t run = 0;
  std::unique_ptr<Connection> connection;
};

Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;
Store::~Store() = default;

bool Store::exists(const fs::path& file) { return fs::exists(file) && !is_empty_database(file); }

Store::Store(const fs::path& file, const RunInfo& info, const Part& part)
    : database_(std::make_unique<Database>(file)) {
  if (exists(file)) refuse_existing(file);
  try {
    database_->connection = std::make_unique<Connection>(file, SQLite::OPEN_CREATE);
    auto& db = database_->connection->db;
    SQLite::Transaction transaction(db);
    make_schema(db);
    database_->run = write_run(db, info);
    write_part(db, database_->run, part);
    transaction.commit();
  } catch (const SQLite::Exception& error) {
    fail(file, error);
  }
}

Store::Store(const fs::path& file) : database_(std::make_unique<Database>(file)) {
  try {
    database_->connection = std::make_unique<Connection>(file, 0);
    auto& db = database_->connection->db;
    check_version(db, file.string());
    if (db.execAndGet("SELECT count(*) FROM part").getInt() != 1)
      throw Error(fmt::format("{}: found several parts or runs, expected one to go on with", file.string()));
    database_->run = db.execAndGet("SELECT run FROM part").getInt64();
  } catch (const SQLite::Exception& error) {
    fail(file, error);
  }
}

void Store::save(const Statistics& statistics, const Part& part, std::span<const Finding> new_findings) {
  try {
    auto& db = database_->connection->db;
    SQLite::Transaction transaction(db);
    write_statistics(db, statistics);
    write_part(db, database_->run, part);
    write_findings(db, database_->run, new_findings);
    transaction.commit();
  } catch (const SQLite::Exception& error) {
    fail(database_->file, error);
  }
}

void Store::add(const ScenePicture& picture) {
  try {
    write_pictures(database_->connection->db, database_->run, std::span(&picture, 1));
  } catch (const SQLite::Exception& error) {
    fail(database_->file, error);
  }
}

Campaign load_campaign(const fs::path& file) {
  const std::string where = file.string();
  if (!fs::exists(file)) throw Error(fmt::format("{}: no such file", where));
  try {
    SQLite::Database db(where, SQLite::OPEN_READONLY);
    check_version(db, where);
    return read_campaign(db, where);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {  // SQLite's, or what is in a field is not what a store has there
    fail(file, error);
  }
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

void write_campaign(const Campaign& campaign, const fs::path& file) {
  refuse_existing(file);
  const fs::path part = file.string() + ".part";
  fs::remove(part);
  try {
    Connection connection(part, SQLite::OPEN_CREATE);
    SQLite::Transaction transaction(connection.db);
    make_schema(connection.db);
    for (const Run& run : campaign.runs) {
      const std::int64_t id = write_run(connection.db, run.info);
      for (const Part& each : run.parts) write_part(connection.db, id, each);
      write_findings(connection.db, id, run.findings);
      write_pictures(connection.db, id, run.pictures);
    }
    write_statistics(connection.db, campaign.statistics);
    transaction.commit();
  } catch (const SQLite::Exception& error) {
    fs::remove(part);
    fail(file, error);
  }
  fs::rename(part, file);
}

}  // namespace nearmiss
