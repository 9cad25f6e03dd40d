// The files of a store: its lock, its logs, and the connections by which SQLite reads and writes it.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <string_view>

namespace nearmiss {

/// A lock held by the process that writes a file. While the process holds the lock, FILE.lock exists next to
/// the file. A symbolic link to the file leads to the same lock. The operating system releases the lock when
/// the process ends, even if the process is killed.
class FileLock {
 public:
  /// Takes the lock. Throws Error if another process holds it, if it cannot be made, or if the file has a
  /// second name (a hard link), under which another process could lock the file separately.
  explicit FileLock(const std::filesystem::path& file);
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

 private:
  std::filesystem::path lock_;
  int descriptor_ = -1;
};

/// The path of a log of a store: the path of the store with `ending` ("-wal" or "-journal") appended. SQLite
/// keeps the log beside the store while a process writes the store; if that process is killed, the log
/// remains.
std::filesystem::path log_of(const std::filesystem::path& file, std::string_view ending);

/// Opens a store to read it. Usually, opening changes nothing. But if a process was killed while it wrote to
/// the store itself (not to its log), SQLite rolls back the unfinished change, for which it uses the journal
/// beside the store.
SQLite::Database open_to_read(const std::filesystem::path& file);

/// A connection for writing.
struct Connection {
  Connection(const std::filesystem::path& file, int flags);
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection();

  SQLite::Database db;
};

/// Whether a file is an empty database.
bool is_empty_database(const std::filesystem::path& file);

}  // namespace nearmiss
