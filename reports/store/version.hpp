// The kind and the version of a store's file, and the way in which errors name it.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <filesystem>

#include "ccd/error.hpp"

namespace nearmiss {

/// Marks an empty database as a store of this version.
void write_version(SQLite::Database& db);

/// Throws Error if the database is not a store, or is a store of another version.
void check_version(SQLite::Database& db);

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
