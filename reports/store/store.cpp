#include "reports/store/store.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string_view>

#include "ccd/query/error.hpp"
#include "corpus/file.hpp"
#include "reports/store/connection.hpp"
#include "reports/store/table.hpp"
#include "reports/text/json.hpp"
#include "reports/text/shell.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Check = std::function<void()>;

constexpr std::uint64_t only_run = 0;

// The tables whose rows belong to runs. Runs are numbered from 0.
using Shards = std::map<std::pair<std::uint64_t, std::uint64_t>, Shard>;  ///< by run and index
/// By run and by the finding's place in the run.
using Findings = std::map<std::pair<std::uint64_t, std::uint64_t>, Finding>;
using Pictures = std::map<std::pair<std::uint64_t, std::string>, json::object_t>;  ///< by run and step

/// Calls `use` with the name and the rows of each table of counters.
template <class SomeStatistics, class Use>
void for_each_table(SomeStatistics& statistics, const Use& use) {
  use("counts", statistics.counts);
  use("oracle", statistics.oracle);
  use("funnel", statistics.funnels);
  use("simulated", statistics.simulated);
  use("factor", statistics.factors);
  use("version", statistics.versions);
  use("seen", statistics.seen);
  use("extreme", statistics.extremes);
}

Statistics read_statistics(Reader& read) {
  std::map<int, Statistics> whole;
  read("campaign", whole);
  Statistics statistics = std::move(whole[0]);
  for_each_table(statistics, [&](const char* table, auto& rows) { read(table, rows); });
  return statistics;
}

std::vector<Run> read_runs(Reader& read) {
  std::map<std::uint64_t, RunInfo> infos;
  Shards shards;
  Findings findings;
  Pictures pictures;
  read("run", infos);
  read("shard", shards);
  read("finding", findings);
  read("picture", pictures);
  std::map<std::uint64_t, Run> runs;
  for (auto& [run, info] : infos) runs[run].info = std::move(info);
  for (auto& [key, shard] : shards) runs[key.first].shards.push_back(std::move(shard));
  for (auto& [key, finding] : findings) runs[key.first].findings.push_back(std::move(finding));
  for (auto& [key, picture] : pictures)
    runs[key.first].pictures.push_back({key.second, json_text(json(std::move(picture)))});
  std::vector<Run> all;
  for (auto& [number, run] : runs) all.push_back(std::move(run));
  return all;
}

/// The rows of the table of findings for consecutive findings of a run. `first` is the place of the first of
/// these findings in the run.
Findings rows_of(std::uint64_t run, std::span<const Finding> findings, std::uint64_t first = 0) {
  Findings rows;
  for (const Finding& each : findings) rows.emplace(std::pair{run, first++}, each);
  return rows;
}

void write_statistics(Save& save, const Statistics& statistics) {
  Statistics whole;
  merge_counters(whole, statistics);
  save.replace("campaign", std::map<int, Statistics>{{0, whole}});
  for_each_table(statistics, [&](const char* table, const auto& rows) { save.replace(table, rows); });
}

/// Writes a campaign to an empty store.
void write_campaign(Save& save, const Campaign& campaign) {
  std::map<std::uint64_t, RunInfo> infos;
  Shards shards;
  Findings findings;
  Pictures pictures;
  for (const Run& run : campaign.runs) {
    const std::uint64_t number = infos.size();
    infos.emplace(number, run.info);
    for (const Shard& shard : run.shards) shards.emplace(std::pair{number, shard.index}, shard);
    findings.merge(rows_of(number, run.findings));
    for (const ScenePicture& picture : run.pictures)
      pictures.emplace(std::pair{number, picture.step}, json::parse(picture.json));
  }
  save.add("run", infos);
  save.add("shard", shards);
  save.add("finding", findings);
  save.add("picture", pictures);
  write_statistics(save, campaign.statistics);
}

/// Reads a campaign. If the row with the facts of a run was lost, the run has no facts. Throws Error for an
/// invalid value, and passes on exceptions of `read`.
Campaign read_campaign(Reader& read) {
  std::vector<Run> runs = read_runs(read);
  return {std::move(runs), read_statistics(read)};
}

/// Runs `act`. Any exception becomes an Error that names the file.
template <class Act>
auto naming(const fs::path& file, const Act& act) {
  try {
    return act();
  } catch (const SQLite::Exception& error) {
    const std::string message = fmt::format("{}: {}", file.string(), error.what());
    if (error.getErrorCode() == SQLITE_BUSY) throw StoreIsLocked(message);
    throw Error(message);
  } catch (const std::exception& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

/// Raises the count of each signature to at least the number of its stored findings, because the row that has
/// the count may be lost.
void count_findings(Campaign& campaign) {
  std::map<Signature, std::uint64_t> stored;
  for (const Finding& finding : campaign.findings()) ++stored[signature_of(finding)];
  for (const auto& [signature, count] : stored) {
    std::uint64_t& seen = campaign.statistics.seen[signature];
    seen = std::max(seen, count);
  }
}

Salvage read_intact(SQLite::Database& db, const Check& check = {}) {
  Reader read(db, check);
  Salvage salvage{read_campaign(read), read.rows(), ""};
  if (read.lost().empty()) return salvage;
  for (const auto& [table, lost] : read.lost()) salvage.lost += (salvage.lost.empty() ? "" : ", ") + lost;
  std::vector<Run>& runs = salvage.campaign.runs;
  if (runs.empty()) runs.emplace_back();
  for (Run& run : runs) {
    run.info.try_emplace("command", "unknown");
    run.info[salvaged_fact] = "lost " + salvage.lost;
    if (read.lost().contains("run") || read.lost().contains("shard"))
      run.info[origin_fact] = "partly unknown";
  }
  count_findings(salvage.campaign);
  return salvage;
}

/// The end of a message about a damaged store. It says how to salvage the store, and how much a salvage would
/// save.
std::string advice(const fs::path& file) {
  try {
    const Salvage salvage = salvage_campaign(file);
    return fmt::format("nearmiss merge NEW.db {} --salvage saves {} rows, without {}",
                       shell_quoted(file.string()), salvage.rows,
                       salvage.lost.empty() ? "any loss" : salvage.lost);
  } catch (const std::exception&) {
    return "nothing can be saved";
  }
}

/// Throws Damage if the structure of the database is damaged. A save into such a database would do more
/// damage, even if all rows are readable.
void check_structure(SQLite::Database& db) {
  const std::string found = db.execAndGet("PRAGMA integrity_check(1)").getString();
  if (found != "ok") throw Damage(found.substr(0, found.find('\n')));
}

/// Whether an error that occurred while a file was read means that the contents of the file are damaged.
/// Other errors mean, for example, that the file cannot be opened.
bool is_damage(const std::exception& error) {
  if (dynamic_cast<const Damage*>(&error) != nullptr) return true;
  const auto* const reason = dynamic_cast<const SQLite::Exception*>(&error);
  return reason != nullptr && reason->getErrorCode() == SQLITE_CORRUPT;
}

/// The name of the log beside a store, if `error` occurred because a killed process left this log, and SQLite
/// may not write in the folder. "" for any other error.
std::string locked_log(const fs::path& file, const std::exception& error) {
  const auto* const reason = dynamic_cast<const SQLite::Exception*>(&error);
  if (reason == nullptr) return "";
  const int code = reason->getErrorCode();
  if (code != SQLITE_CANTOPEN && code != SQLITE_READONLY) return "";
  for (const char* ending : {"-wal", "-journal"})
    if (const fs::path log = log_of(file, ending); fs::exists(log)) return log.filename().string();
  return "";
}

/// Reads a store of this version. Throws Error if the store cannot be read. If the store is damaged, the
/// message of the Error also says how much a salvage would save.
Campaign read_store(const fs::path& file, bool checks_structure, const Check& check = {}) {
  expect_regular_file(file);
  return naming(file, [&] {
    try {
      SQLite::Database db = open_to_read(file);
      const SQLite::Transaction one_save(db);  // another process may save meanwhile
      expect_store(db);
      if (checks_structure) check_structure(db);
      Salvage whole = read_intact(db, check);
      if (!whole.lost.empty()) throw Damage("some rows are not as they were saved");
      return std::move(whole.campaign);
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

void refuse_existing(const fs::path& file) {
  if (fs::exists(file)) throw Error(fmt::format("{}: exists already, expected a new file", file.string()));
}

}  // namespace

struct Store::Database {
  explicit Database(fs::path path) : file(std::move(path)), lock(file) {}

  /// Passes a Save, which is one transaction, to `act`, and then commits the transaction.
  template <class Act>
  void change(const Act& act) {
    naming(file, [&] {
      Save save(connection->db);
      act(save);
      save.commit();
    });
  }

  fs::path file;
  FileLock lock;
  std::unique_ptr<Connection> connection;
};

Store::~Store() = default;

bool Store::exists(const fs::path& file) {
  return fs::exists(file) && !naming(file, [&] { return is_empty_database(file); });
}

void Store::remove(const fs::path& file) {
  std::error_code ignored;
  for (const char* part : {"", "-wal", "-shm", "-journal"}) fs::remove(file.string() + part, ignored);
}

Store::Store(const fs::path& file, const RunInfo& info, const Shard& shard)
    : database_(std::make_unique<Database>(file)) {
  if (exists(file)) refuse_existing(file);
  naming(file, [&] { database_->connection = std::make_unique<Connection>(file, SQLite::OPEN_CREATE); });
  database_->change([&](Save& save) { write_campaign(save, {{{info, {shard}, {}}}, {}}); });
}

Store::Store(const fs::path& file, Campaign* found, const Check& check)
    : database_(std::make_unique<Database>(file)) {
  Campaign whole = read_store(file, true, check);
  naming(file, [&] {
    if (whole.runs.size() != 1 || whole.runs.front().shards.size() != 1)
      throw Error("found several shards or runs, expected one to continue");
    database_->connection = std::make_unique<Connection>(file, 0);
  });
  if (found != nullptr) *found = std::move(whole);
}

void Store::save(const Statistics& statistics, const Shard& shard, std::span<const Finding> new_findings) {
  database_->change([&](Save& save) {
    write_statistics(save, statistics);
    save.replace("shard", Shards{{{only_run, shard.index}, shard}});
    save.add("finding", rows_of(only_run, new_findings, save.rows("finding")));
  });
}

void Store::replace(std::span<const Finding> findings) {
  database_->change([&](Save& save) {
    save.clear("finding");
    save.add("finding", rows_of(only_run, findings));
  });
}

void Store::add(const ScenePicture& picture) {
  database_->change([&](Save& save) {
    save.add("picture",
             Pictures{{{only_run, picture.step}, json::parse(picture.json).get<json::object_t>()}});
  });
}

Campaign load_campaign(const fs::path& file) {
  if (!fs::exists(file)) throw Error(fmt::format("{}: no such file", file.string()));
  return read_store(file, false);
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

Salvage salvage_campaign(const fs::path& file) {
  expect_regular_file(file);
  return naming(file, [&] {
    SQLite::Database db = open_to_read(file);
    db.exec("PRAGMA writable_schema = ON");  // lets SQLite read a file with a missing end or a damaged schema
    const SQLite::Transaction one_save(db);  // another process may save meanwhile
    db.exec("PRAGMA schema_version");        // throws if the file is no database
    Salvage salvage = read_intact(db);
    if (salvage.rows == 0) throw Error("found no intact row, so that nothing can be saved");
    return salvage;
  });
}

void write_campaign(const Campaign& campaign, const fs::path& file) {
  refuse_existing(file);
  PartFile part(file);
  naming(file, [&] {
    SQLite::Database db(part.path().string(), SQLite::OPEN_READWRITE);
    // The disk may be nearly full, so SQLite keeps its journal in memory. This is safe, because no other
    // process sees the file yet.
    db.exec("PRAGMA journal_mode = MEMORY; PRAGMA synchronous = FULL;");
    Save save(db);
    write_campaign(save, campaign);
    save.commit();
  });
  part.put_in_place();
}

}  // namespace nearmiss
