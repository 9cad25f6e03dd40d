// How a store's file is opened, its kind and version, and the way in which errors name it.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <filesystem>
#include <string_view>

#include "ccd/error.hpp"

namespace nearmiss {

/// The log with this ending that SQLite keeps beside a store while it is written, and that a killed writer leaves there.
std::filesystem::path log_of(const std::filesystem::path& file, std::string_view ending);

/// How long to wait for another process that reads a store, or opens or closes it. A process that is told to stop does so within
/// two seconds.
inline constexpr int patience_ms = 1500;

/// Opens a store to read it. It is changed only if its writer was killed while it changed the file itself: then
/// SQLite takes back the half-done change, by the journal beside the store.
SQLite::Database open_to_read(const std::filesystem::path& file);

/// Whether a database has no tables. A kill before the first save leaves such a file.
bool is_empty(const SQLite::Database& db);

/// Marks an empty database as a store of this version.
void write_version(SQLite::Database& db);

/// The version of the tables and of their contents; every change raises it. Only stores of this version are read.
inline constexpr int store_version = 19;

/// Throws Error if the database is not a store of this version.
void expect_version(SQLite::Database& db);

/// Runs `act`. Any exception becomes an Error that names the file.
template <class Act>
auto naming(const std::filesystem::path& file, const Act& act) {
  try {
    return act();
  } catch (const std::exception& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace nearmiss
