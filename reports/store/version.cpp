#include "reports/store/version.hpp"

namespace nearmiss {

namespace {

constexpr int application_id = 0x6e656172;  // "near"

/// Version of the tables and of their contents; every change raises it.
constexpr int schema_version = 17;

}  // namespace

void write_version(SQLite::Database& db) {
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

}  // namespace nearmiss
