#include "reports/store/version.hpp"

namespace nearmiss {

namespace {

constexpr int application_id = 0x6e656172;  // "near"

}  // namespace

std::filesystem::path log_of(const std::filesystem::path& file, std::string_view ending) {
  std::filesystem::path log = weakly_canonical(file);  // as SQLite follows links
  log += ending;
  return log;
}

SQLite::Database open_to_read(const std::filesystem::path& file) {
  const bool change_is_half_done = exists(log_of(file, "-journal"));
  return {file.string(), change_is_half_done ? SQLite::OPEN_READWRITE : SQLite::OPEN_READONLY, patience_ms};
}

bool is_empty(const SQLite::Database& db) {
  return !SQLite::Statement(db, "SELECT 1 FROM sqlite_schema").executeStep();
}

void write_version(SQLite::Database& db) {
  db.exec(
      fmt::format("PRAGMA user_version = {}; PRAGMA application_id = {};", store_version, application_id));
}

void expect_version(SQLite::Database& db) {
  if (db.execAndGet("PRAGMA application_id").getInt() != application_id)
    throw Error(is_empty(db)
                    ? "found an empty database, as a kill before the first save leaves it, expected a store "
                      "of nearmiss"
                    : "found another kind of database, expected a store of nearmiss");
  const int version = db.execAndGet("PRAGMA user_version").getInt();
  if (version != store_version)
    throw Error(fmt::format("found store version {}, expected {}", version, store_version));
}

}  // namespace nearmiss
