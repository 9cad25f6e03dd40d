// The tables of counters.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include "reports/statistics/statistics.hpp"
#include "reports/store/table_reader.hpp"

namespace nearmiss {

/// Makes the tables in an empty database.
void make_statistics_tables(SQLite::Database& db);

/// Replaces all counters.
void write_statistics(SQLite::Database& db, const Statistics& statistics);

/// Reads all counters. Throws Error for an invalid value, and passes on exceptions of `read`, SQLite and the JSON
/// library.
Statistics read_statistics(TableReader& read);

}  // namespace nearmiss
