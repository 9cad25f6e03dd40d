// libFuzzer target: the reader of stores, *.db, and the commands that use a store. The input is not a store
// but the SQL statements that make a store, one per line. If libFuzzer changed the bytes of a store at
// random, the reader would nearly always refuse the store because of a wrong checksum.
#include "reports/store/store.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "fuzz/libfuzzer/reader_target.hpp"
#include "reports/csv.hpp"
#include "reports/report.hpp"
#include "reports/store/table.hpp"
#include "reports/text/json.hpp"

namespace nearmiss::libfuzzer {

namespace {

namespace fs = std::filesystem;

/// A folder for the files of one input.
class Folder {
 public:
  Folder() {
    std::string path = (fs::temp_directory_path() / "nearmiss-XXXXXX").string();
    expect(mkdtemp(path.data()) != nullptr, "a folder for temporary files");
    path_ = path;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path_); }

  [[nodiscard]] fs::path file(const char* name) const { return path_ / name; }

 private:
  fs::path path_;
};

/// A store that SQL statements make in memory.
class OpenStore {
 public:
  OpenStore() : db_(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE) {
    // Without limits, a statement could run forever, fill the memory, or write to other files.
    constexpr int most_instructions = 100'000;
    constexpr int longest_value = 1 << 20;
    sqlite3_progress_handler(
        db_.getHandle(), most_instructions, [](void*) { return 1; }, nullptr);
    sqlite3_limit(db_.getHandle(), SQLITE_LIMIT_LENGTH, longest_value);
    sqlite3_limit(db_.getHandle(), SQLITE_LIMIT_ATTACHED, 0);
    sqlite3_hard_heap_limit64(64 << 20);
  }
  OpenStore(const OpenStore&) = delete;
  OpenStore& operator=(const OpenStore&) = delete;
  ~OpenStore() { sqlite3_hard_heap_limit64(0); }

  /// Runs statements, one per line, and skips those that SQLite refuses.
  void run(std::istream& statements) {
    for (std::string line; std::getline(statements, line);) try_to([&] { db_.exec(line); });
  }

  /// Corrects the checksums of all rows, and the numbers of rows that the store records.
  void seal() {
    for (const std::string& table : tables())
      try_to([&] {
        if (table == "contents") return;
        const Contents contents = seal_rows(table);
        SQLite::Statement replace(db_, "INSERT OR REPLACE INTO contents VALUES (?, ?, 0)");
        replace.bind(1, nlohmann::json(table).dump());
        replace.bind(2, nlohmann::json(contents).dump());
        replace.exec();
      });
    try_to([&] { seal_rows("contents"); });
  }

  void write(const fs::path& file) const {
    sqlite3_int64 size = 0;
    auto* const bytes = sqlite3_serialize(db_.getHandle(), "main", &size, 0);
    std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(bytes), size);
    sqlite3_free(bytes);
  }

 private:
  template <class Change>
  static void try_to(const Change& change) {
    try {
      change();
    } catch (const SQLite::Exception&) {  // refused
    }
  }

  std::vector<std::string> tables() {
    std::vector<std::string> names;
    try_to([&] {
      SQLite::Statement each(
          db_, "SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT GLOB '*[^a-z]*'");
      while (each.executeStep()) names.push_back(each.getColumn(0).getString());
    });
    return names;
  }

  Contents seal_rows(const std::string& table) {
    Contents contents;
    SQLite::Statement row(db_, fmt::format("SELECT rowid, key, value FROM \"{}\"", table));
    std::vector<std::pair<std::int64_t, std::int64_t>> sums;
    while (row.executeStep())
      sums.emplace_back(row.getColumn(0).getInt64(),
                        checksum(table, row.getColumn(1).getString(), row.getColumn(2).getString()));
    SQLite::Statement update(db_, fmt::format("UPDATE \"{}\" SET checksum = ? WHERE rowid = ?", table));
    for (const auto& [id, sum] : sums) {
      update.bind(1, sum);
      update.bind(2, id);
      update.exec();
      update.reset();
      contents.add(static_cast<std::uint64_t>(sum));
    }
    return contents;
  }

  SQLite::Database db_;
};

std::string content(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// Writes a campaign to a file, reads the file, and writes the campaign again. Both files must have the same
/// bytes.
void expect_round_trip(const Campaign& campaign, const Folder& folder) {
  write_campaign(campaign, folder.file("once.db"));
  write_campaign(load_campaign(folder.file("once.db")), folder.file("twice.db"));
  expect(content(folder.file("once.db")) == content(folder.file("twice.db")), "the same store");
}

void report(const Campaign& campaign) {
  report_json(campaign, {.since = changes(campaign, campaign)}).dump();
  statistics_csv(campaign.statistics);
  classes_csv(campaign.statistics);
  distances_csv(campaign.statistics);
  times_csv(campaign.statistics);
  findings_csv(campaign);
}

void resume(const fs::path& file) {
  Store store(file);
  const Campaign campaign = load_campaign(file);
  store.save(campaign.statistics, campaign.runs.front().shards.front(), campaign.runs.front().findings);
}

template <class Command>
void run(const Command& command) {
  try {
    command();
  } catch (const Error&) {  // refused
  }
}

}  // namespace

void read(std::istream& in) {
  const Folder folder;
  const fs::path file = folder.file("input.db");
  {
    OpenStore store;
    store.run(in);
    store.seal();
    store.write(file);
  }
  run([&] { expect_round_trip(salvage_campaign(file).campaign, folder); });
  run([&] { report(load_campaigns({&file, 1})); });
  run([&] { resume(file); });
}

}  // namespace nearmiss::libfuzzer
