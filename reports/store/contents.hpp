// Checksums of a store. SQLite trusts what it reads from a file; a flipped bit changes a number unnoticed.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <span>
#include <string>
#include <variant>

#include "ccd/error.hpp"

namespace nearmiss {

/// A value as SQLite stores it: INTEGER, REAL or TEXT.
using Value = std::variant<std::int64_t, double, std::string>;

/// The store is not as it was written. The message says which part.
class Damage : public Error {
 public:
  using Error::Error;
};

/// The checksum of a row, which its last column holds: the first 64 bits of a SHA-256 digest of the table's name and
/// the values.
std::uint64_t checksum(const std::string& table, std::span<const Value> values);

/// The number of rows of a table, and the sum of their checksums modulo 2^64. A save updates both without reading other
/// rows. They reveal rows that are missing, doubled, or left from an earlier save.
struct Contents {
  std::uint64_t rows = 0, sum = 0;

  void add(std::uint64_t row_checksum) {
    ++rows;
    sum += row_checksum;
  }
  bool operator==(const Contents&) const = default;
};

/// Makes the table of contents in an empty database.
void make_contents(SQLite::Database& db);

/// Sets the contents of a table.
void write_contents(SQLite::Database& db, const std::string& table, const Contents& contents);

/// The contents of a table, as last written. Throws Damage.
Contents read_contents(SQLite::Database& db, const std::string& table);

}  // namespace nearmiss
