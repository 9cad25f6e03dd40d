#include "reports/store.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "ccd/error.hpp"
#include "corpus/query_text.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int schema_version = 4;
constexpr int application_id = 0x6e656172;  // "near"

constexpr const char* schema = R"sql(
  CREATE TABLE run (id INTEGER PRIMARY KEY, info TEXT NOT NULL) STRICT;
  CREATE TABLE statistics (
    subject TEXT NOT NULL, kind TEXT NOT NULL CHECK (kind IN ('vt', 'ee')), family TEXT NOT NULL,
    queries INTEGER NOT NULL, collisions INTEGER NOT NULL, positives INTEGER NOT NULL,
    false_negatives INTEGER NOT NULL, false_positives INTEGER NOT NULL, refuted_bounds INTEGER NOT NULL,
    true_by_stage TEXT NOT NULL, false_by_stage TEXT NOT NULL, distances TEXT NOT NULL, farthest TEXT NOT NULL,
    timed_queries INTEGER NOT NULL, nanoseconds INTEGER NOT NULL,
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
    what TEXT NOT NULL, subject TEXT NOT NULL, family TEXT NOT NULL, kind TEXT NOT NULL, query TEXT NOT NULL,
    provenance TEXT NOT NULL, ratio REAL NOT NULL, signature TEXT NOT NULL, shrunk TEXT NOT NULL,
    PRIMARY KEY (what, subject, provenance, query)) STRICT;
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

// SQLite's integers are signed; a count never comes near 2^63.
std::int64_t stored(std::uint64_t count) { return static_cast<std::int64_t>(count); }
std::uint64_t count(const SQLite::Column& column) { return static_cast<std::uint64_t>(column.getInt64()); }

void write_statistics(SQLite::Database& db, const Statistics& statistics) {
  SQLite::Statement insert(db, "INSERT OR REPLACE INTO statistics VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
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
    insert.bind(++i, stored(c.timed_queries));
    insert.bind(++i, stored(c.nanoseconds));
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

void write_findings(SQLite::Database& db, std::span<const Finding> findings) {
  SQLite::Statement insert(db, "INSERT OR IGNORE INTO finding VALUES (?,?,?,?,?,?,?,?,?)");
  for (const Finding& finding : findings) {
    insert.bind(1, std::string(name(finding.what)));
    insert.bind(2, finding.subject);
    insert.bind(3, finding.family);
    insert.bind(4, std::string(short_name(finding.query.kind)));
    insert.bind(5, to_line(finding.query));
    insert.bind(6, finding.provenance);
    insert.bind(7, finding.ratio);
    insert.bind(8, finding.signature);
    insert.bind(9, to_line(finding.shrunk));
    insert.exec();
    insert.reset();
  }
}

void write_runs(SQLite::Database& db, std::span<const RunInfo> runs) {
  SQLite::Statement insert(db, "INSERT INTO run (info) VALUES (?)");
  for (const RunInfo& run : runs) {
    insert.bind(1, json(run).dump());
    insert.exec();
    insert.reset();
  }
}

Finding::What parse_what(const std::string& text, const std::string& where) {
  for (const auto what : {Finding::What::false_negative, Finding::What::refuted_bound,
                          Finding::What::oracle_disagreement, Finding::What::truth_mismatch})
    if (name(what) == text) return what;
  throw Error(fmt::format("{}: found a finding '{}', which this version does not know", where, text));
}

Extreme::Of parse_of(const std::string& text, const std::string& where) {
  for (const auto of :
       {Extreme::Of::accepting_tolerance, Extreme::Of::keeping_tolerance, Extreme::Of::distance})
    if (name(of) == text) return of;
  throw Error(fmt::format("{}: found an extreme of '{}', which this version does not know", where, text));
}

/// The order of a campaign's findings: those that fail in the same way stand together.
bool is_before(const Finding& a, const Finding& b) {
  const auto key = [](const Finding& f) {
    return std::tie(f.what, f.subject, f.signature, f.provenance, f.query.kind, f.query.x, f.family, f.ratio,
                    f.shrunk.x);
  };
  return key(a) < key(b);
}

[[noreturn]] void fail(const fs::path& file, const std::exception& error) {
  throw Error(fmt::format("{}: {}", file.string(), error.what()));
}

}  // namespace

struct Store::Database {
  Database(fs::path path, int flags) : file(std::move(path)), db(file.string(), flags) {}
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  ~Database() {
    try {
      db.exec("PRAGMA journal_mode = DELETE");  // one plain file is left, for readers that may not write
    } catch (const SQLite::Exception&) {
      return;  // then the log stays beside it, and nothing is lost
    }
  }

  fs::path file;
  SQLite::Database db;
};

Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;
Store::~Store() = default;

Store::Store(const fs::path& file, std::span<const RunInfo> runs) {
  if (fs::exists(file)) throw Error(fmt::format("{}: exists already, expected a new file", file.string()));
  try {
    database_ = std::make_unique<Database>(file, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    auto& db = database_->db;
    db.exec("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON;");
    SQLite::Transaction transaction(db);
    db.exec(schema);
    db.exec(
        fmt::format("PRAGMA user_version = {}; PRAGMA application_id = {}; INSERT INTO oracle VALUES (0, 0);",
                    schema_version, application_id));
    write_runs(db, runs);
    transaction.commit();
  } catch (const SQLite::Exception& error) {
    fail(file, error);
  }
}

void Store::save(const Statistics& statistics, std::span<const Finding> new_findings) {
  try {
    SQLite::Transaction transaction(database_->db);
    write_statistics(database_->db, statistics);
    write_findings(database_->db, new_findings);
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
    if (db.execAndGet("PRAGMA application_id").getInt() != application_id)
      throw Error(fmt::format("{}: found another kind of database, expected a store of nearmiss", where));
    const int version = db.execAndGet("PRAGMA user_version").getInt();
    if (version != schema_version)
      throw Error(fmt::format("{}: found store version {}, expected {}", where, version, schema_version));

    SQLite::Statement runs(db, "SELECT info FROM run ORDER BY id");
    while (runs.executeStep())
      campaign.runs.push_back(json::parse(runs.getColumn(0).getString()).get<RunInfo>());

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
      c.timed_queries = count(rows.getColumn(++i));
      c.nanoseconds = count(rows.getColumn(++i));
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

    SQLite::Statement findings(db, "SELECT * FROM finding");
    while (findings.executeStep()) {
      const Kind kind = parse_kind(findings.getColumn(3).getString(), where);
      campaign.findings.push_back(
          {parse_what(findings.getColumn(0).getString(), where), findings.getColumn(1).getString(),
           findings.getColumn(2).getString(), parse_line(kind, findings.getColumn(4).getString(), where),
           findings.getColumn(5).getString(), findings.getColumn(6).getDouble(),
           findings.getColumn(7).getString(), parse_line(kind, findings.getColumn(8).getString(), where)});
    }
    std::sort(campaign.findings.begin(), campaign.findings.end(), is_before);
  } catch (const SQLite::Exception& error) {
    fail(file, error);
  } catch (const json::exception& error) {
    fail(file, error);
  }
  return campaign;
}

Campaign merge_campaigns(std::span<const Campaign> campaigns) {
  Campaign merged;
  for (const Campaign& each : campaigns) {
    merged.statistics.merge(each.statistics);
    merged.runs.insert(merged.runs.end(), each.runs.begin(), each.runs.end());
    merged.findings.insert(merged.findings.end(), each.findings.begin(), each.findings.end());
  }
  std::sort(merged.runs.begin(), merged.runs.end());
  // Of those that are shrunk to the same query the first one in their order is kept.
  std::sort(merged.findings.begin(), merged.findings.end(), is_before);
  std::set<std::tuple<Signature, Kind, std::array<double, 24>>> known;
  std::erase_if(merged.findings, [&](const Finding& f) {
    return !known.emplace(signature_of(f), f.shrunk.kind, f.shrunk.x).second;
  });
  return merged;
}

void write_campaign(const Campaign& campaign, const fs::path& file) {
  if (fs::exists(file)) throw Error(fmt::format("{}: exists already, expected a new file", file.string()));
  const fs::path part = file.string() + ".part";
  fs::remove(part);
  try {
    Store store(part, campaign.runs);
    store.save(campaign.statistics, campaign.findings);
  } catch (...) {
    fs::remove(part);
    throw;
  }
  fs::rename(part, file);
}

}  // namespace nearmiss
