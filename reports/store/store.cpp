#include "reports/store/store.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include "ccd/error.hpp"
#include "reports/store/file_lock.hpp"
#include "reports/store/run_tables.hpp"
#include "reports/store/statistics_tables.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

constexpr int application_id = 0x6e656172;  // "near"

/// Version of the tables and of their contents; every change raises it.
constexpr int schema_version = 13;

void make_schema(SQLite::Database& db) {
  make_run_tables(db);
  make_statistics_tables(db);
  db.exec(
      fmt::format("PRAGMA user_version = {}; PRAGMA application_id = {};", schema_version, application_id));
}

/// Throws Error if the database is not a store, or is a store of another version.
void check_version(SQLite::Database& db) {
  if (db.execAndGet("PRAGMA application_id").getInt() != application_id)
    throw Error("found another kind of database, expected a store of nearmiss");
  const int version = db.execAndGet("PRAGMA user_version").getInt();
  if (version != schema_version)
    throw Error(fmt::format("found store version {}, expected {}", version, schema_version));
}

/// Runs `act`. Any exception becomes an Error that names the file.
template <class Act>
auto naming(const fs::path& file, const Act& act) {
  try {
    return act();
  } catch (const std::exception& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
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
      db.exec("PRAGMA journal_mode = DELETE");  // leaves one plain file, for readers without write permission
    } catch (const SQLite::Exception&) {
      return;  // then the log remains next to the file, and nothing is lost
    }
  }

  SQLite::Database db;
};

/// Whether a file is a database without tables. A kill during the creation of a store leaves such a file.
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
  std::uint64_t run = 0;
  std::unique_ptr<Connection> connection;
};

Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;
Store::~Store() = default;

bool Store::exists(const fs::path& file) { return fs::exists(file) && !is_empty_database(file); }

Store::Store(const fs::path& file, const RunInfo& info, const Shard& shard)
    : database_(std::make_unique<Database>(file)) {
  if (exists(file)) refuse_existing(file);
  naming(file, [&] { database_->connection = std::make_unique<Connection>(file, SQLite::OPEN_CREATE); });
  database_->change([&](SQLite::Database& db) {
    make_schema(db);
    write_run(db, database_->run, info);
    write_shard(db, database_->run, shard);
  });
}

Store::Store(const fs::path& file) : database_(std::make_unique<Database>(file)) {
  naming(file, [&] {
    database_->connection = std::make_unique<Connection>(file, 0);
    auto& db = database_->connection->db;
    check_version(db);
    const std::vector<Run> runs = read_runs(db);
    if (runs.size() != 1 || runs.front().shards.size() != 1)
      throw Error("found several shards or runs, expected one to continue");
  });
}

void Store::save(const Statistics& statistics, const Shard& shard, std::span<const Finding> new_findings) {
  database_->change([&](SQLite::Database& db) {
    write_statistics(db, statistics);
    write_shard(db, database_->run, shard);
    write_findings(db, database_->run, new_findings);
  });
}

void Store::replace(std::span<const Finding> findings) {
  database_->change([&](SQLite::Database& db) { replace_findings(db, database_->run, findings); });
}

void Store::add(const ScenePicture& picture) {
  database_->change(
      [&](SQLite::Database& db) { write_pictures(db, database_->run, std::span(&picture, 1)); });
}

Campaign load_campaign(const fs::path& file) {
  if (!fs::exists(file)) throw Error(fmt::format("{}: no such file", file.string()));
  return naming(file, [&] {
    SQLite::Database db(file.string(), SQLite::OPEN_READONLY);
    check_version(db);
    return Campaign{read_runs(db), read_statistics(db)};
  });
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
  for (std::uint64_t id = 0; id < campaign.runs.size(); ++id) {
    const Run& run = campaign.runs[id];
    write_run(connection.db, id, run.info);
    for (const Shard& each : run.shards) write_shard(connection.db, id, each);
    write_findings(connection.db, id, run.findings);
    write_pictures(connection.db, id, run.pictures);
  }
  write_statistics(connection.db, campaign.statistics);
  transaction.commit();
}

}  // namespace

void write_campaign(const Campaign& campaign, const fs::path& file) {
  refuse_existing(file);
  const fs::path part = file.string() + ".part";
  fs::remove(part);
  try {
    naming(file, [&] { write_all(campaign, part); });
  } catch (const Error&) {
    fs::remove(part);
    throw;
  }
  fs::rename(part, file);
}

}  // namespace nearmiss
