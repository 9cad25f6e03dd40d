// The rows of a store: what stands where in its tables. The file itself is store.hpp's.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <span>
#include <string>

#include "reports/campaign.hpp"

namespace nearmiss {

/// Of the tables; any change of them, or of what stands in them, raises it.
inline constexpr int schema_version = 11;

/// Makes the tables in an empty database.
void make_tables(SQLite::Database& db);

/// Adds a run without its parts and findings; its id.
std::int64_t write_run(SQLite::Database& db, const RunInfo& info);

/// Adds or replaces a part of a run.
void write_part(SQLite::Database& db, std::int64_t run, const Part& part);

/// Replaces all counters.
void write_statistics(SQLite::Database& db, const Statistics& statistics);

/// Adds findings of a run, behind those that are there.
void write_findings(SQLite::Database& db, std::int64_t run, std::span<const Finding> findings);

/// Adds pictures of a run.
void write_pictures(SQLite::Database& db, std::int64_t run, std::span<const ScenePicture> pictures);

/// Everything. Throws Error, with `where`, for a value that no store has; and what SQLite and the JSON
/// library throw.
Campaign read_campaign(SQLite::Database& db, const std::string& where);

}  // namespace nearmiss
