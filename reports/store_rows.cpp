#include "reports/store_rows.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "ccd/error.hpp"
#include "corpus/query_text.hpp"

namespace nearmiss {

namespace {

using nlohmann::json;

constexpr const char* schema = R"sql(
  CREATE TABLE run (id INTEGER PRIMARY KEY, info TEXT NOT NULL UNIQUE) STRICT;
  CREATE TABLE part (
    run INTEGER NOT NULL REFERENCES run, shard INTEGER NOT NULL, shards INTEGER NOT NULL,
    rounds INTEGER NOT NULL, cases INTEGER NOT NULL, complete INTEGER NOT NULL, started TEXT NOT NULL,
    seconds REAL NOT NULL, environment TEXT NOT NULL,
    PRIMARY KEY (run, shard)) STRICT;
  CREATE TABLE statistics (
    subject TEXT NOT NULL, kind TEXT NOT NULL CHECK (kind IN ('vt', 'ee')), family TEXT NOT NULL,
    queries INTEGER NOT NULL, collisions INTEGER NOT NULL, positives INTEGER NOT NULL,
    false_negatives INTEGER NOT NULL, false_positives INTEGER NOT NULL, refuted_bounds INTEGER NOT NULL,
    true_by_stage TEXT NOT NULL, false_by_stage TEXT NOT NULL, rejected_by TEXT NOT NULL,
    distances TEXT NOT NULL, farthest TEXT NOT NULL, faults TEXT NOT NULL,
    batch_times TEXT NOT NULL, nanoseconds INTEGER NOT NULL, each_time TEXT NOT NULL, slowest TEXT NOT NULL,
    PRIMARY KEY (subject, kind, family)) STRICT;
  CREATE TABLE oracle_statistics (
    kind TEXT NOT NULL CHECK (kind IN ('vt', 'ee')), family TEXT NOT NULL, queries INTEGER NOT NULL,
    collisions INTEGER NOT NULL, by_stage TEXT NOT NULL, near_bounds INTEGER NOT NULL,
    compared INTEGER NOT NULL, compared_collisions INTEGER NOT NULL, missed_by_parity INTEGER NOT NULL,
    PRIMARY KEY (kind, family)) STRICT;
  CREATE TABLE extreme (
    name TEXT PRIMARY KEY, of TEXT NOT NULL, value TEXT NOT NULL, kind TEXT NOT NULL, query TEXT NOT NULL,
    provenance TEXT NOT NULL, queries INTEGER NOT NULL) STRICT;
  CREATE TABLE funnel (
    step TEXT NOT NULL, kind TEXT NOT NULL CHECK (kind IN ('vt', 'ee')), pairs TEXT NOT NULL,
    touching INTEGER NOT NULL, finding_ns INTEGER NOT NULL, deciding_ns INTEGER NOT NULL,
    PRIMARY KEY (step, kind)) STRICT;
  CREATE TABLE picture (
    run INTEGER NOT NULL REFERENCES run, step TEXT NOT NULL, picture TEXT NOT NULL,
    PRIMARY KEY (run, step)) STRICT;
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

}  // namespace

void make_tables(SQLite::Database& db) {
  db.exec(schema);
  db.exec("INSERT INTO oracle VALUES (0, 0)");
}

void write_statistics(SQLite::Database& db, const Statistics& statistics) {
  SQLite::Statement insert(
      db, "INSERT OR REPLACE INTO statistics VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
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
    insert.bind(++i, json(c.rejected_by).dump());
    insert.bind(++i, json(c.distances.bins).dump());
    insert.bind(++i, far_json(c.farthest).dump());
    insert.bind(++i, json(c.faults).dump());
    const auto batches = c.times.batches.find({key.kind, key.family});
    insert.bind(++i, batches == c.times.batches.end() ? "[]" : json(batches->second.bins()).dump());
    insert.bind(++i, stored(c.times.nanoseconds));
    insert.bind(++i, json(c.times.each.bins).dump());
    insert.bind(++i, slow_json(c.times.slowest).dump());
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
  SQLite::Statement funnel(db, "INSERT OR REPLACE INTO funnel VALUES (?,?,?,?,?,?)");
  for (const auto& [key, each] : statistics.funnels) {
    funnel.bind(1, key.first);
    funnel.bind(2, std::string(short_name(key.second)));
    funnel.bind(3, json(each.pairs).dump());
    funnel.bind(4, stored(each.touching));
    funnel.bind(5, stored(each.finding_ns));
    funnel.bind(6, stored(each.deciding_ns));
    funnel.exec();
    funnel.reset();
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

void write_pictures(SQLite::Database& db, std::int64_t run, std::span<const ScenePicture> pictures) {
  SQLite::Statement insert(db, "INSERT OR REPLACE INTO picture VALUES (?,?,?)");
  for (const ScenePicture& picture : pictures) {
    insert.bind(1, run);
    insert.bind(2, picture.step);
    insert.bind(3, picture.json);
    insert.exec();
    insert.reset();
  }
}

void write_part(SQLite::Database& db, std::int64_t run, const Part& part) {
  SQLite::Statement insert(db, "INSERT OR REPLACE INTO part VALUES (?,?,?,?,?,?,?,?,?)");
  int i = 0;
  insert.bind(++i, run);
  for (const std::uint64_t n :
       {part.shard, part.shards, part.rounds, part.cases, std::uint64_t{part.complete}})
    insert.bind(++i, stored(n));
  insert.bind(++i, part.started);
  insert.bind(++i, part.seconds);
  insert.bind(++i, json(part.environment).dump());
  insert.exec();
}

std::int64_t write_run(SQLite::Database& db, const RunInfo& info) {
  SQLite::Statement insert(db, "INSERT INTO run (info) VALUES (?)");
  insert.bind(1, json(info).dump());
  insert.exec();
  return db.getLastInsertRowid();
}

namespace {

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

/// Where in a campaign each run stands, by its id.
using RunIndex = std::map<std::int64_t, std::size_t>;

RunIndex read_runs(SQLite::Database& db, Campaign& campaign) {
  RunIndex index;
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
                          .cases = count(parts.getColumn(4)),
                          .complete = parts.getColumn(5).getInt() != 0,
                          .started = parts.getColumn(6).getString(),
                          .seconds = parts.getColumn(7).getDouble(),
                          .environment = json::parse(parts.getColumn(8).getString()).get<RunInfo>()});
  return index;
}

void read_counts(SQLite::Database& db, const std::string& where, Statistics& statistics) {
  SQLite::Statement rows(db, "SELECT * FROM statistics");
  while (rows.executeStep()) {
    const Key key{rows.getColumn(0).getString(), parse_kind(rows.getColumn(1).getString(), where),
                  rows.getColumn(2).getString()};
    Counts& c = statistics.counts[key];
    c.is_sample = is_random(key.family);
    int i = 2;
    for (std::uint64_t* n :
         {&c.queries, &c.collisions, &c.positives, &c.false_negatives, &c.false_positives, &c.refuted_bounds})
      *n = count(rows.getColumn(++i));
    json::parse(rows.getColumn(++i).getString()).get_to(c.true_by_stage);
    json::parse(rows.getColumn(++i).getString()).get_to(c.false_by_stage);
    json::parse(rows.getColumn(++i).getString()).get_to(c.rejected_by);
    json::parse(rows.getColumn(++i).getString()).get_to(c.distances.bins);
    c.farthest = far_cases(json::parse(rows.getColumn(++i).getString()), key.kind, where);
    json::parse(rows.getColumn(++i).getString()).get_to(c.faults);
    if (BatchTimes::Bins bins = json::parse(rows.getColumn(++i).getString()); !bins.empty())
      c.times.batches[{key.kind, key.family}] = BatchTimes(std::move(bins));
    c.times.nanoseconds = count(rows.getColumn(++i));
    json::parse(rows.getColumn(++i).getString()).get_to(c.times.each.bins);
    c.times.slowest = slow_cases(json::parse(rows.getColumn(++i).getString()), key.kind, where);
  }
}

void read_oracle(SQLite::Database& db, const std::string& where, Statistics& statistics) {
  SQLite::Statement by_family(db, "SELECT * FROM oracle_statistics");
  while (by_family.executeStep()) {
    OracleCounts& c = statistics.oracle[{parse_kind(by_family.getColumn(0).getString(), where),
                                         by_family.getColumn(1).getString()}];
    c.queries = count(by_family.getColumn(2));
    c.collisions = count(by_family.getColumn(3));
    json::parse(by_family.getColumn(4).getString()).get_to(c.by_stage);
    c.near_bounds = count(by_family.getColumn(5));
    c.compared = count(by_family.getColumn(6));
    c.compared_collisions = count(by_family.getColumn(7));
    c.missed_by_parity = count(by_family.getColumn(8));
  }
  SQLite::Statement oracle(db, "SELECT disagreements, truth_mismatches FROM oracle");
  if (oracle.executeStep()) {
    statistics.oracle_disagreements = count(oracle.getColumn(0));
    statistics.mismatches_with_recorded_truth = count(oracle.getColumn(1));
  }
}

void read_extremes(SQLite::Database& db, const std::string& where, Statistics& statistics) {
  SQLite::Statement extremes(db, "SELECT * FROM extreme");
  while (extremes.executeStep()) {
    const std::string name = extremes.getColumn(0).getString();
    const Kind kind = parse_kind(extremes.getColumn(3).getString(), where);
    statistics.extremes[name] = {parse_of(extremes.getColumn(1).getString(), where),
                                 name,
                                 std::stod(extremes.getColumn(2).getString()),
                                 parse_line(kind, extremes.getColumn(4).getString(), where),
                                 extremes.getColumn(5).getString(),
                                 count(extremes.getColumn(6))};
  }
}

void read_funnels(SQLite::Database& db, const std::string& where, Statistics& statistics) {
  SQLite::Statement funnels(db, "SELECT * FROM funnel");
  while (funnels.executeStep()) {
    Funnel& funnel =
        statistics
            .funnels[{funnels.getColumn(0).getString(), parse_kind(funnels.getColumn(1).getString(), where)}];
    json::parse(funnels.getColumn(2).getString()).get_to(funnel.pairs);
    funnel.touching = count(funnels.getColumn(3));
    funnel.finding_ns = count(funnels.getColumn(4));
    funnel.deciding_ns = count(funnels.getColumn(5));
  }
}

void read_seen(SQLite::Database& db, const std::string& where, Statistics& statistics) {
  SQLite::Statement seen(db, "SELECT * FROM seen");
  while (seen.executeStep())
    statistics.seen[{parse_what(seen.getColumn(0).getString(), where), seen.getColumn(1).getString(),
                     seen.getColumn(2).getString()}] = count(seen.getColumn(3));
}

void read_findings(SQLite::Database& db, const std::string& where, const RunIndex& index,
                   Campaign& campaign) {
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
}

void read_pictures(SQLite::Database& db, const RunIndex& index, Campaign& campaign) {
  SQLite::Statement pictures(db, "SELECT * FROM picture ORDER BY run, step");
  while (pictures.executeStep()) {
    const json content = json::parse(pictures.getColumn(2).getString());  // throws where it is none
    campaign.runs.at(index.at(pictures.getColumn(0).getInt64()))
        .pictures.push_back({pictures.getColumn(1).getString(), content.dump()});
  }
}

}  // namespace

Campaign read_campaign(SQLite::Database& db, const std::string& where) {
  Campaign campaign;
  const RunIndex index = read_runs(db, campaign);
  read_counts(db, where, campaign.statistics);
  read_oracle(db, where, campaign.statistics);
  read_extremes(db, where, campaign.statistics);
  read_funnels(db, where, campaign.statistics);
  read_seen(db, where, campaign.statistics);
  read_findings(db, where, index, campaign);
  read_pictures(db, index, campaign);
  return campaign;
}

}  // namespace nearmiss
