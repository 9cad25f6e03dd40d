// The tables of runs: their shards, findings and pictures.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <span>
#include <vector>

#include "reports/campaign/campaign.hpp"

namespace nearmiss {

/// Makes the tables in an empty database.
void make_run_tables(SQLite::Database& db);

/// Adds a run without its shards, findings and pictures.
void write_run(SQLite::Database& db, std::uint64_t run, const RunInfo& info);

/// Adds or replaces a shard of a run.
void write_shard(SQLite::Database& db, std::uint64_t run, const Shard& shard);

/// Appends findings to those of a run.
void write_findings(SQLite::Database& db, std::uint64_t run, std::span<const Finding> findings);
/// Replaces all findings of the only run.
void replace_findings(SQLite::Database& db, std::uint64_t run, std::span<const Finding> findings);

/// Adds pictures of a run.
void write_pictures(SQLite::Database& db, std::uint64_t run, std::span<const ScenePicture> pictures);

/// Reads all runs. Throws Error for an invalid value, and passes on exceptions of SQLite and the JSON
/// library.
std::vector<Run> read_runs(SQLite::Database& db);

}  // namespace nearmiss
