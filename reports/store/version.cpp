#include "reports/store/version.hpp"

namespace nearmiss {

namespace {

constexpr int application_id = 0x6e656172;  // "near"

}  // namespace

void write_version(SQLite::Database& db) {
  db.exec(
      fmt::format("PRAGMA user_version = {}; PRAGMA application_id = {};", store_version, application_id));
}

int version_of(SQLite::Database& db, int oldest) {
  if (db.execAndGet("PRAGMA application_id").getInt() != application_id)
    throw Error("found another kind of database, expected a store of nearmiss");
  const int version = db.execAndGet("PRAGMA user_version").getInt();
  if (version >= oldest && version <= store_version) return version;
  throw Error(fmt::format("found store version {}, expected {}{}", version,
                          oldest < store_version ? fmt::format("{} to ", oldest) : "", store_version));
}

}  // namespace nearmiss
