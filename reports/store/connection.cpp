#include "reports/store/connection.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sqlite3.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "ccd/query/error.hpp"
#include "corpus/file.hpp"
#include "reports/store/table.hpp"

namespace nearmiss {

namespace fs = std::filesystem;

namespace {

/// How long a process waits while another process reads, opens or closes the same store. The wait is short,
/// because a process that is told to stop should end within two seconds.
constexpr int patience_ms = 1500;

/// Throws Error if the journal beside a store names another file, because SQLite would delete that file when
/// it rolls back an unfinished change. Journals that nearmiss writes name no other file.
void expect_own_journal(const fs::path& file) {
  constexpr std::array<char, 8> magic{'\xd9', '\xd5', '\x05', '\xf9', '\x20', '\xa1', '\x63', '\xd7'};
  const fs::path journal = log_of(file, "-journal");
  if (!fs::exists(journal)) return;
  expect_regular_file(journal);
  std::array<char, magic.size()> last{};
  std::ifstream in(journal, std::ios::binary | std::ios::ate);
  if (in.tellg() < std::streamoff{magic.size()}) return;
  in.seekg(-std::streamoff{magic.size()}, std::ios::end);
  if (in.read(last.data(), last.size()) && last == magic)
    throw Error(
        fmt::format("found the journal {} of a change to several files, expected one to this store alone",
                    journal.filename().string()));
}

/// Checks a store's journal (expect_own_journal), and returns the path by which SQLite opens the store. The
/// path is absolute, because for a store with the relative path ":memory:", SQLite would open a database in
/// memory instead of the file.
std::string path_for_sqlite(const fs::path& file) {
  expect_own_journal(file);
  return fs::absolute(file).string();
}

}  // namespace

FileLock::FileLock(const fs::path& file) : lock_(true_path(file).string() + ".lock") {
  std::error_code ignored;
  if (const auto names = fs::hard_link_count(file, ignored); !ignored && names > 1)
    throw Error(
        fmt::format("{}: found a file with {} names (hard links), expected one", file.string(), names));
  while (true) {
    descriptor_ = open(lock_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
    if (descriptor_ < 0)
      throw Error(fmt::format("{}: cannot be made: {}", lock_.string(), std::strerror(errno)));
    struct stat held {};
    if (fstat(descriptor_, &held) != 0 || !S_ISREG(held.st_mode)) {
      close(descriptor_);
      throw Error(fmt::format("{}: found no regular file, expected one or none", lock_.string()));
    }
    const bool locked = flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
    const bool is_in_place = locked && fstat(descriptor_, &held) == 0 && held.st_nlink > 0;
    if (is_in_place && held.st_size == 0) return;
    close(descriptor_);
    if (is_in_place)
      throw Error(
          fmt::format("{}: found a file with {} bytes, expected none: the lock of {} would replace it",
                      lock_.string(), held.st_size, file.string()));
    if (!locked) throw Error(fmt::format("{}: another process is writing it", file.string()));
    // The process that held the lock has removed the lock file. Try again with a new lock file.
  }
}

FileLock::~FileLock() {
  unlink(lock_.c_str());
  close(descriptor_);
}

fs::path log_of(const fs::path& file, std::string_view ending) {
  fs::path log = weakly_canonical(file);  // resolves links, as SQLite does
  log += ending;
  return log;
}

SQLite::Database open_to_read(const fs::path& file) {
  constexpr int most_bytes = 1 << 26;  // limit for a key or a value
  const bool change_is_half_done = fs::exists(log_of(file, "-journal"));
  SQLite::Database db(path_for_sqlite(file),
                      change_is_half_done ? SQLite::OPEN_READWRITE : SQLite::OPEN_READONLY, patience_ms);
  sqlite3_limit(db.getHandle(), SQLITE_LIMIT_LENGTH, most_bytes);
  return db;
}

Connection::Connection(const fs::path& file, int flags)
    : db(path_for_sqlite(file), SQLite::OPEN_READWRITE | flags, patience_ms) {
  db.exec("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL;");
}

Connection::~Connection() {
  try {
    // This waits for a shorter time than a save does, because all results are already saved.
    db.setBusyTimeout(patience_ms / 3);
    // Removes the log, so that users without write permission can read the store.
    db.exec("PRAGMA journal_mode = DELETE");
  } catch (const SQLite::Exception&) {
    return;  // the log stays next to the file, so nothing is lost
  }
}

bool is_empty_database(const fs::path& file) {
  const std::string path = path_for_sqlite(file);
  try {
    SQLite::Database db(path, SQLite::OPEN_READWRITE);  // rolls back an unfinished transaction
    return is_empty(db);
  } catch (const SQLite::Exception&) {
    return false;
  }
}

}  // namespace nearmiss
