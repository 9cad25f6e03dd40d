// The tables of runs: their shards, findings and pictures.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <span>
#include <vector>

#include "reports/campaign/campaign.hpp"
#include "reports/store/table_reader.hpp"

namespace nearmiss {

/// Makes the tables in an empty database.
void make_run_tables(SQLite::Database& db);

/// Adds runs, numbered from 0.
void write_runs(SQLite::Database& db, std::span<const Run> runs);

/// Replaces the only shard of the only run.
void replace_shard(SQLite::Database& db, const Shard& shard);

/// Appends findings to those of the only run.
void write_findings(SQLite::Database& db, std::span<const Finding> findings);
/// Replaces all findings of the only run.
void replace_findings(SQLite::Database& db, std::span<const Finding> findings);

/// Adds a picture to the only run.
void write_picture(SQLite::Database& db, const ScenePicture& picture);

/// Reads all runs. A run whose row was lost has no facts. Throws Error for an invalid value, and passes on exceptions
/// of `read`, SQLite and the JSON library.
std::vector<Run> read_runs(TableReader& read);

}  // namespace nearmiss
