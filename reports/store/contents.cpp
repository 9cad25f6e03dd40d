#include "reports/store/contents.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <vector>

#include "reports/sha256.hpp"

namespace nearmiss {

namespace {

/// The bytes of an integer in a digest, from the lowest one.
std::array<char, 8> bytes_of(std::uint64_t number) {
  std::array<char, 8> bytes{};
  for (char& byte : bytes) {
    byte = static_cast<char>(number & 0xffU);
    number >>= 8U;
  }
  return bytes;
}

void add_number(Sha256& digest, char type, std::uint64_t number) {
  const auto bytes = bytes_of(number);
  digest.add({&type, 1}).add({bytes.data(), bytes.size()});
}

void add_text(Sha256& digest, const std::string& text) {
  add_number(digest, 't', text.size());
  digest.add(text);
}

std::uint64_t checksum_of(const std::string& table, const Contents& contents) {
  const std::vector<Value> values{table, static_cast<std::int64_t>(contents.rows),
                                  static_cast<std::int64_t>(contents.sum)};
  return checksum("contents", values);
}

}  // namespace

std::uint64_t checksum(const std::string& table, std::span<const Value> values) {
  Sha256 digest;
  add_text(digest, table);
  for (const Value& value : values) {
    if (const auto* integer = std::get_if<std::int64_t>(&value))
      add_number(digest, 'i', static_cast<std::uint64_t>(*integer));
    else if (const auto* real = std::get_if<double>(&value))
      add_number(digest, 'r', std::bit_cast<std::uint64_t>(*real + 0.0));  // SQLite stores -0 as 0
    else
      add_text(digest, std::get<std::string>(value));
  }
  const auto all = digest.digest();
  std::uint64_t first = 0;
  for (int i = 7; i >= 0; --i) first = first << 8U | all[static_cast<std::size_t>(i)];
  return first;
}

void make_contents(SQLite::Database& db) {
  db.exec(
      "CREATE TABLE contents (name TEXT NOT NULL PRIMARY KEY, rows INTEGER NOT NULL, sum INTEGER NOT NULL, "
      "checksum INTEGER NOT NULL) STRICT");
}

void write_contents(SQLite::Database& db, const std::string& table, const Contents& contents) {
  SQLite::Statement insert(db, "INSERT OR REPLACE INTO contents VALUES (?, ?, ?, ?)");
  insert.bind(1, table);
  insert.bind(2, static_cast<std::int64_t>(contents.rows));
  insert.bind(3, static_cast<std::int64_t>(contents.sum));
  insert.bind(4, static_cast<std::int64_t>(checksum_of(table, contents)));
  insert.exec();
}

Contents read_contents(SQLite::Database& db, const std::string& table) {
  // NOT INDEXED: an index may be damaged where the row is intact.
  SQLite::Statement row(db, "SELECT rows, sum, checksum FROM contents NOT INDEXED WHERE name = ?");
  row.bind(1, table);
  if (!row.executeStep()) throw Damage(fmt::format("the number of rows of table {} is lost", table));
  const auto number = [&](int i) { return static_cast<std::uint64_t>(row.getColumn(i).getInt64()); };
  const Contents contents{number(0), number(1)};
  if (number(2) != checksum_of(table, contents))
    throw Damage(fmt::format("the number of rows of table {} does not match its checksum", table));
  return contents;
}

}  // namespace nearmiss
