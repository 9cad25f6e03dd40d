#include "reports/store.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "ccd/error.hpp"
#include "corpus/query_text.hpp"
#include "reports/file_lock.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int schema_version = 6;
constexpr int application_id = 0x6e656172;  // "near"

constexpr const char* schema = R"sql(
  CREATE TABLE run (id INTEGER PRIMARY KEY, info TEXT NOT NULL UNIQUE) STRICT;
  CREATE TABLE part (
    run INTEGER NOT NULL REFERENCES run, shard INTEGER NOT NULL, shards INTEGER NOT NULL,
    rounds INTEGER NOT NULL, complete INTEGER NOT NULL, started TEXT NOT NULL, seconds REAL NOT NULL,
    environment TEXT NOT NULL,
    PRIMARY KEY (run, shard)) STRICT;
  CREATE TABLE statistics (
    subject TEXT NOT NULL, kind TEXT NOT NULL CHECK (kind IN ('vt', 'ee')), family TEXT NOT NULL,
    queries INTEGER NOT NULL, collisions INTEGER NOT NULL, positives INTEGER NOT NULL,
    false_negatives INTEGER NOT NULL, false_positives INTEGER NOT NULL, refuted_bounds INTEGER NOT NULL,
    true_by_stage TEXT NOT NULL, false_by_stage TEXT NOT NULL, distances TEXT NOT NULL, farthest TEXT NOT NULL,
    faults TEXT NOT NULL, timed_queries INTEGER NOT NULL, nanoseconds INTEGER NOT NULL, times TEXT NOT NULL,
    slowest TEXT NOT NULL,
    PRIMARY KEY (subject, kind, family)) STRICT;
  CREATE TABLE oracle_statistics (
    kind TEXT NOT NULL CHECK (kind IN ('vt', 'ee')), family TEXT NOT NULL, queries INTEGER NOT NULL,
    collisions INTEGER NOT NULL, by_stage TEXT NOT NULL, near_bounds INTEGER NOT NULL,
    compared INTEGER NOT NULL, compared_collisions INTEGER NOT NULL, missed_by_parity INTEGER NOT NULL,
    PRIMARY KEY (kind, family)) STRICT;
  CREATE TABLE extreme (
    name TEXT PRIMARY KEY, of TEXT NOT NULL, value TEXT NOT NULL, kind TEXT NOT NULL, query TEXT NOT NULL,
    provenance TEXT NOT NULL, queries INTEGER NOT NULL) STRICT;
  CREATE TABLE oracle (disagreements INTEGER NOT NULL, truth_mismatches INTEGER NOT NULL) STRICT;
  CREATE TABLE seen (
    what TEXT NOT NULL, subject TEXT NOT NULL, signature TEXT NOT NULL, times INTEGER NOT NULL,
    PRIMARY KEY (what, subject, signature)) STRICT;
  CREATE TABLE finding (
    id INTEGER PRIMARY KEY, run INTEGER NOT NULL REFERENCES run, round INTEGER NOT NULL,
    what TEXT NOT NULL, subject TEXT NOT NULL, family TEXT NOT NULL, kind TEXT NOT NULL, query TEXT NOT NULL,
    provenance TEXT NOT NULL, ratio REAL NOT NULL, signature TEXT NOT NULL, shrunk TEXT NOT NULL) STRICT;
)sql";

json far_json(const std::vector<FarCase>& cases) {
  json list = json::array();
  for (const FarCase& far : cases) list.push_back({to_hex(far.ratio), far.provenance, to_line(far.query)});
  return list;
}

std::vector<FarCase> far_cases(const json& list, Kind kind, const std::string& where) {
  std::vector<FarCase> cases;
  for (const json& each : list)
    cases.push_back({parse_number(each.at(0).get<std::string>(), where),
                     parse_line(kind, each.at(2).get<std::string>(), where), each.at(1).get<std::string>()});
  return cases;
}

json slow_json(const std::vector<SlowCase>& cases) {
  json list = json::array();
  for (const SlowCase& slow : cases) list.push_back({slow.nanoseconds, slow.provenance, to_line(slow.query)});
  return list;
}

std::vector<SlowCase> slow_cases(const json& list, Kind kind, const std::string& where) {
  std::vector<SlowCase> cases;
  for (const json& each : list)
    cases.push_back({each.at(0).get<std::uint64_t>(), parse_line(kind, each.at(2).get<std::string>(), where),
                     each.at(1).get<std::string>()});
  return cases;
}

// SQLite's integers are signed; a count never comes near 2^63.
std::int64_t stored(std::uint64_t count) { return static_cast<std::int64_t>(count); }
std::uint64_t count(const SQLite::Column& column) { return static_cast<std::uint64_t>(column.getInt64()); }

void write_statistics(SQLite::Database& db, const Statistics& statistics) {
  SQLite::Statement insert(db,
                           "INSERT OR REPLACE INTO statistics VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
  for (const auto& [key, c] : statistics.counts) {
    int i = 0;
    insert.bind(++i, key.subject);
    insert.bind(++i, std::string(short_name(key.kind)));
    insert.bind(++i, key.family);
    for (const std::uint64_t n :
         {c.queries, c.collisions, c.positives, c.false_negatives, c.false_positives, c.refuted_bounds})
      insert.bind(++i, stored(n));
    insert.bind(++i, json(c.true_by_stage).dump());
    insert.bind(++i, json(c.false_by_stage).dump());
    insert.bind(++i, json(c.distances.bins).dump());
    insert.bind(++i, far_json(c.farthest).dump());
    insert.bind(++i, json(c.faults).dump());
    insert.bind(++i, stored(c.timed_queries));
    insert.bind(++i, stored(c.nanoseconds));
    insert.bind(++i, json(c.times.bins).dump());
    insert.bind(++i, slow_json(c.slowest).dump());
    insert.exec();
    insert.reset();
  }
  SQLite::Statement by_family(db, "INSERT OR REPLACE INTO oracle_statistics VALUES (?,?,?,?,?,?,?,?,?)");
  for (const auto& [key, c] : statistics.oracle) {
    by_family.bind(1, std::string(short_name(key.first)));
    by_family.bind(2, key.second);
    by_family.bind(3, stored(c.queries));
    by_family.bind(4, stored(c.collisions));
    by_family.bind(5, json(c.by_stage).dump());
    by_family.bind(6, stored(c.near_bounds));
    by_family.bind(7, stored(c.compared));
    by_family.bind(8, stored(c.compared_collisions));
    by_family.bind(9, stored(c.missed_by_parity));
    by_family.exec();
    by_family.reset();
  }
  SQLite::Statement extreme(db, "INSERT OR REPLACE INTO extreme VALUES (?,?,?,?,?,?,?)");
  for (const auto& [name, each] : statistics.extremes) {
    extreme.bind(1, name);
    extreme.bind(2, std::string(nearmiss::name(each.of)));
    extreme.bind(3, fmt::format("{}", each.value));  // it may be infinite
    extreme.bind(4, std::string(short_name(each.query.kind)));
    extreme.bind(5, to_line(each.query));
    extreme.bind(6, each.provenance);
    extreme.bind(7, stored(each.queries));
    extreme.exec();
    extreme.reset();
  }
  SQLite::Statement seen(db, "INSERT OR REPLACE INTO seen VALUES (?,?,?,?)");
  for (const auto& [signature, times] : statistics.seen) {
    seen.bind(1, std::string(name(signature.what)));
    seen.bind(2, signature.subject);
    seen.bind(3, signature.text);
    seen.bind(4, stored(times));
    seen.exec();
    seen.reset();
  }
  SQLite::Statement oracle(db, "UPDATE oracle SET disagreements = ?, truth_mismatches = ?");
  oracle.bind(1, stored(statistics.oracle_disagreements));
  oracle.bind(2, stored(statistics.mismatches_with_recorded_truth));
  oracle.exec();
}

void write_findings(SQLite::Database& db, std::int64_t run, std::span<const Finding> findings) {
  SQLite::Statement insert(db, "INSERT INTO finding VALUES (NULL,?,?,?,?,?,?,?,?,?,?,?)");
  for (const Finding& finding : findings) {
    int i = 0;
    insert.bind(++i, run);
    insert.bind(++i, stored(finding.round));
    insert.bind(++i, std::string(name(finding.what)));
    insert.bind(++i, finding.subject);
    insert.bind(++i, finding.family);
    insert.bind(++i, std::string(short_name(finding.query.kind)));
    insert.bind(++i, to_line(finding.query));
    insert.bind(++i, finding.provenance);
    insert.bind(++i, finding.ratio);
    insert.bind(++i, finding.signature);
    insert.bind(++i, to_line(finding.shrunk));
    insert.exec();
    insert.reset();
  }
}

void write_part(SQLite::Database& db, std::int64_t run, const Part& part) {
  SQLite::Statement insert(db, "INSERT OR REPLACE INTO part VALUES (?,?,?,?,?,?,?,?)");
  int i = 0;
  insert.bind(++i, run);
  for (const std::uint64_t n : {part.shard, part.shards, part.rounds, std::uint64_t{part.complete}})
    insert.bind(++i, stored(n));
  insert.bind(++i, part.started);
  insert.bind(++i, part.seconds);
  insert.bind(++i, json(part.environment).dump());
  insert.exec();
}

/// The new run's id.
std::int64_t write_run(SQLite::Database& db, const RunInfo& info) {
  SQLite::Statement insert(db, "INSERT INTO run (info) VALUES (?)");
  insert.bind(1, json(info).dump());
  insert.exec();
  return db.getLastInsertRowid();
}

void make_schema(SQLite::Database& db) {
  db.exec(schema);
  db.exec(
      fmt::format("PRAGMA user_version = {}; PRAGMA application_id = {}; INSERT INTO oracle VALUES (0, 0);",
                  schema_version, application_id));
}

/// Throws Error where it is no store, or one of another version.
void check_version(SQLite::Database& db, const std::string& where) {
  if (db.execAndGet("PRAGMA application_id").getInt() != application_id)
    throw Error(fmt::format("{}: found another kind of database, expected a store of nearmiss", where));
  const int version = db.execAndGet("PRAGMA user_version").getInt();
  if (version != schema_version)
    throw Error(fmt::format("{}: found store version {}, expected {}", where, version, schema_version));
}

Finding::What parse_what(const std::string& text, const std::string& where) {
  for (const auto what :
       {Finding::What::false_negative, Finding::What::refuted_bound, Finding::What::oracle_disagreement,
        Finding::What::truth_mismatch, Finding::What::fault})
    if (name(what) == text) return what;
  throw Error(fmt::format("{}: found a finding '{}', which this version does not know", where, text));
}

Extreme::Of parse_of(const std::string& text, const std::string& where) {
  for (const auto of :
       {Extreme::Of::accepting_tolerance, Extreme::Of::keeping_tolerance, Extreme::Of::distance})
    if (name(of) == text) return of;
  throw Error(fmt::format("{}: found an extreme of '{}', which this version does not know", where, text));
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

Store::Store(const fs::path& file, const RunInfo& info, const Part& part)
    : database_(std::make_unique<Database>(file)) {
  refuse_existing(file);
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

Campaign load_campaign(const fs::path& file) {
  const std::string where = file.string();
  if (!fs::exists(file)) throw Error(fmt::format("{}: no such file", where));
  Campaign campaign;
  try {
    SQLite::Database db(where, SQLite::OPEN_READONLY);
    check_version(db, where);

    std::map<std::int64_t, std::size_t> index;  // of each run's id
    SQLite::Statement runs(db, "SELECT id, info FROM run ORDER BY id");
    while (runs.executeStep()) {
      index[runs.getColumn(0).getInt64()] = campaign.runs.size();
      campaign.runs.push_back({json::parse(runs.getColumn(1).getString()).get<RunInfo>(), {}, {}});
    }
    SQLite::Statement parts(db, "SELECT * FROM part ORDER BY run, shard");
    while (parts.executeStep())
      campaign.runs.at(index.at(parts.getColumn(0).getInt64()))
          .parts.push_back({.shard = count(parts.getColumn(1)),
                            .shards = count(parts.getColumn(2)),
                            .rounds = count(parts.getColumn(3)),
                            .complete = parts.getColumn(4).getInt() != 0,
                            .started = parts.getColumn(5).getString(),
                            .seconds = parts.getColumn(6).getDouble(),
                            .environment = json::parse(parts.getColumn(7).getString()).get<RunInfo>()});

    SQLite::Statement rows(db, "SELECT * FROM statistics");
    while (rows.executeStep()) {
      const Key key{rows.getColumn(0).getString(), parse_kind(rows.getColumn(1).getString(), where),
                    rows.getColumn(2).getString()};
      Counts& c = campaign.statistics.counts[key];
      int i = 2;
      for (std::uint64_t* n : {&c.queries, &c.collisions, &c.positives, &c.false_negatives,
                               &c.false_positives, &c.refuted_bounds})
        *n = count(rows.getColumn(++i));
      json::parse(rows.getColumn(++i).getString()).get_to(c.true_by_stage);
      json::parse(rows.getColumn(++i).getString()).get_to(c.false_by_stage);
      json::parse(rows.getColumn(++i).getString()).get_to(c.distances.bins);
      c.farthest = far_cases(json::parse(rows.getColumn(++i).getString()), key.kind, where);
      json::parse(rows.getColumn(++i).getString()).get_to(c.faults);
      c.timed_queries = count(rows.getColumn(++i));
      c.nanoseconds = count(rows.getColumn(++i));
      json::parse(rows.getColumn(++i).getString()).get_to(c.times.bins);
      c.slowest = slow_cases(json::parse(rows.getColumn(++i).getString()), key.kind, where);
    }

    SQLite::Statement by_family(db, "SELECT * FROM oracle_statistics");
    while (by_family.executeStep()) {
      OracleCounts& c = campaign.statistics.oracle[{parse_kind(by_family.getColumn(0).getString(), where),
                                                    by_family.getColumn(1).getString()}];
      c.queries = count(by_family.getColumn(2));
      c.collisions = count(by_family.getColumn(3));
      json::parse(by_family.getColumn(4).getString()).get_to(c.by_stage);
      c.near_bounds = count(by_family.getColumn(5));
      c.compared = count(by_family.getColumn(6));
      c.compared_collisions = count(by_family.getColumn(7));
      c.missed_by_parity = count(by_family.getColumn(8));
    }

    SQLite::Statement extremes(db, "SELECT * FROM extreme");
    while (extremes.executeStep()) {
      const std::string name = extremes.getColumn(0).getString();
      const Kind kind = parse_kind(extremes.getColumn(3).getString(), where);
      campaign.statistics.extremes[name] = {parse_of(extremes.getColumn(1).getString(), where),
                                            name,
                                            std::stod(extremes.getColumn(2).getString()),
                                            parse_line(kind, extremes.getColumn(4).getString(), where),
                                            extremes.getColumn(5).getString(),
                                            count(extremes.getColumn(6))};
    }

    SQLite::Statement oracle(db, "SELECT disagreements, truth_mismatches FROM oracle");
    if (oracle.executeStep()) {
      campaign.statistics.oracle_disagreements = count(oracle.getColumn(0));
      campaign.statistics.mismatches_with_recorded_truth = count(oracle.getColumn(1));
    }

    SQLite::Statement seen(db, "SELECT * FROM seen");
    while (seen.executeStep())
      campaign.statistics.seen[{parse_what(seen.getColumn(0).getString(), where),
                                seen.getColumn(1).getString(), seen.getColumn(2).getString()}] =
          count(seen.getColumn(3));

    SQLite::Statement findings(db, "SELECT * FROM finding ORDER BY id");
    while (findings.executeStep()) {
      const auto text = [&](int i) { return findings.getColumn(i).getString(); };
      const Kind kind = parse_kind(text(6), where);
      campaign.runs.at(index.at(findings.getColumn(1).getInt64()))
          .findings.push_back({.what = parse_what(text(3), where),
                               .subject = text(4),
                               .family = text(5),
                               .query = parse_line(kind, text(7), where),
                               .provenance = text(8),
                               .ratio = findings.getColumn(9).getDouble(),
                               .signature = text(10),
                               .shrunk = parse_line(kind, text(11), where),
                               .round = count(findings.getColumn(2))});
    }
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {  // SQLite's, or what is in a field is not what a store has there
    fail(file, error);
  }
  return campaign;
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
