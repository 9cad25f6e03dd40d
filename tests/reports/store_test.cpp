// A store keeps all saved results, whatever happens after a save.
#include "reports/store/store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdint>
#include <string>
#include <string_view>
#include <thread>

#include "ccd/query/error.hpp"
#include "reports/store/table.hpp"
#include "tests/refused.hpp"
#include "tests/reports/stored.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

using testing::Database;
using ::testing::HasSubstr;
using testing::info;
using testing::shard;
using testing::some_finding;
using testing::some_statistics;

class StoreTest : public testing::TemporaryFolder {};

TEST_F(StoreTest, GivesBackWhatWasSaved) {
  const std::vector findings{some_finding("first"), some_finding("second")};
  const std::string picture = R"({"points":[1,2]})";
  {
    Shard before = shard;
    before.cases = 3;
    Store store(file("a.db"), info, before);
    store.save({}, before, std::span(findings).first(1));
    store.add({"scene:cloth", picture});
  }
  Statistics statistics = some_statistics("wang");
  statistics.extremes["denormal"] = {
      Extreme::Of::accepting_tolerance, "denormal", 5e-324, testing::stored_query, "uniform:1:4", 7};
  Store(file("a.db")).save(statistics, shard, std::span(findings).last(1));
  const Campaign campaign = load_campaign(file("a.db"));
  EXPECT_EQ(campaign.statistics, statistics);
  EXPECT_EQ(campaign.runs,
            (std::vector<nearmiss::Run>{{info, {shard}, findings, {{"scene:cloth", picture}}}}));
}

TEST_F(StoreTest, GivesBackAMergedCampaign) {
  Shard other = shard;
  other.index = 3;
  const Campaign campaign{
      {{info, {shard, other}, {some_finding("x")}}, {{{"seed", "2"}}, {}, {some_finding("y")}}}, {}};
  write_campaign(campaign, file("a.db"));
  EXPECT_EQ(load_campaign(file("a.db")).runs, campaign.runs);
  EXPECT_REFUSED(Store(file("a.db")), "a.db: found several shards");
}

TEST_F(StoreTest, ReplacesItsFindings) {
  const std::vector<Finding> findings{some_finding("first"), some_finding("second"), some_finding("third")};
  Store store(file("a.db"), info, shard);
  store.save({}, shard, findings);
  store.replace(std::span(findings).last(1));
  store.save({}, shard, std::span(findings).first(1));
  EXPECT_EQ(load_campaign(file("a.db")).runs[0].findings, (std::vector{findings[2], findings[0]}));
}

TEST_F(StoreTest, AKillDuringItsCreationLeavesNoStore) {
  Database(file("a.db")).execute("PRAGMA journal_mode = WAL");
  EXPECT_GT(std::filesystem::file_size(file("a.db")), 0);
  EXPECT_FALSE(Store::exists(file("a.db")));
  EXPECT_REFUSED(load_campaign(file("a.db")), "a.db: found an empty database");
  { const Store store(file("a.db"), info, shard); }
  EXPECT_TRUE(Store::exists(file("a.db")));
}

TEST_F(StoreTest, AKillDuringASaveLosesNothingThatWasSaved) {
  { Store(file("a.db"), info, shard).save(some_statistics("wang"), shard, {}); }
  Store store(file("a.db"));
  Shard later = shard;
  later.cases = 78;
  store.save(some_statistics("wang"), later, {});
  std::filesystem::create_directory(file("killed"));
  for (const char* name : {"a.db", "a.db-wal"}) copy_file(file(name), file("killed") / name);
  const std::string log = read("killed/a.db-wal");
  for (const auto& [size, saved] : {std::pair{log.size(), later}, {log.size() / 2, shard}}) {
    write("killed/a.db-wal", log.substr(0, size) + "the beginning of another save");
    EXPECT_EQ(load_campaign(file("killed/a.db")).runs[0].shards, std::vector{saved});
  }
}

TEST_F(StoreTest, AKillDuringAChangeOfTheFileItselfIsTakenBack) {
  { Store(file("a.db"), info, shard).save(some_statistics("wang"), shard, {}); }
  std::filesystem::create_directory(file("killed"));
  {
    const Database db(file("a.db"));
    // Without a cache, SQLite writes the change to the file before the commit. If a process is killed between
    // this write and the commit, it leaves the file in this state.
    db.execute(
        "PRAGMA cache_size = 0; BEGIN IMMEDIATE; DELETE FROM shard; PRAGMA user_version = 1;"
        "CREATE TABLE other AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n LIMIT 9999) "
        "SELECT i FROM n");
    for (const char* name : {"a.db", "a.db-journal"}) copy_file(file(name), file("killed") / name);
  }
  ASSERT_NE(read("a.db"), read("killed/a.db"));
  create_symlink(file("killed") / "a.db", file("link.db"));
  EXPECT_EQ(load_campaign(file("link.db")).statistics, some_statistics("wang"));
  EXPECT_EQ(read("a.db"), read("killed/a.db"));
}

// A journal may name another file, which SQLite would delete.
TEST_F(StoreTest, AJournalThatNamesAnotherFileIsRefused) {
  { Store(file("a.db"), info, shard).save(some_statistics("wang"), shard, {}); }
  write("precious", "mine");
  constexpr std::string_view magic = "\xd9\xd5\x05\xf9\x20\xa1\x63\xd7";
  constexpr std::uint32_t page = 4096;
  const auto number = [](std::uint32_t value) {
    return std::string{static_cast<char>(value >> 24), static_cast<char>(value >> 16 & 0xff),
                       static_cast<char>(value >> 8 & 0xff), static_cast<char>(value & 0xff)};
  };
  std::string journal(magic);
  journal += number(0) + number(0) + number(static_cast<std::uint32_t>(read("a.db").size() / page)) +
             number(512) + number(page);
  journal.resize(512);
  const std::string name = file("precious").string();
  std::uint32_t sum = 0;
  for (const char c : name) sum += static_cast<std::uint32_t>(c);
  journal += number(0x40000000 / page + 1) + name + number(static_cast<std::uint32_t>(name.size())) +
             number(sum) + std::string(magic);
  write("a.db-journal", journal);
  EXPECT_REFUSED(load_campaign(file("a.db")), "the journal a.db-journal of a change to several files");
  EXPECT_REFUSED(salvage_campaign(file("a.db")), "a.db-journal");
  EXPECT_REFUSED(Store(file("a.db")), "a.db-journal");
  EXPECT_REFUSED(Store(file("a.db"), info, shard), "a.db-journal");
  EXPECT_EQ(read("precious"), "mine");
}

TEST_F(StoreTest, WaitsForReadersWhenItIsOpened) {
  { Store(file("a.db"), info, shard).save(some_statistics("wang"), shard, {}); }
  const Database reader(file("a.db"));
  reader.execute("BEGIN; SELECT count(*) FROM shard");
  std::jthread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    reader.execute("COMMIT");
  });
  Store(file("a.db")).save(some_statistics("wang"), shard, {});
  later.join();
  EXPECT_EQ(load_campaign(file("a.db")).statistics, some_statistics("wang"));
}

TEST_F(StoreTest, ItsReadingCanBeEnded) {
  struct Ended {};
  { Store(file("a.db"), info, shard).save(some_statistics("wang"), shard, {}); }
  Campaign found;
  int rows = 0;
  const auto end_at_the_third_row = [&] {
    if (++rows == 3) throw Ended();
  };
  EXPECT_THROW(Store(file("a.db"), &found, end_at_the_third_row), Ended);
  EXPECT_EQ(rows, 3);
  Store(file("a.db"), &found);  // throws if a lock was left behind
  EXPECT_EQ(found.statistics, some_statistics("wang"));
}

TEST_F(StoreTest, IsWrittenByOneAtATimeUnderAnyName) {
  {
    const Store store(file("a.db"), info, shard);
    std::filesystem::create_symlink(file("a.db"), file("link.db"));
    for (const char* name : {"a.db", "link.db"})
      EXPECT_REFUSED(Store(file(name)), std::string(name) + ": another process is writing it");
    std::filesystem::create_hard_link(file("a.db"), file("hard.db"));
    EXPECT_REFUSED(Store(file("hard.db")), "hard.db: found a file with 2 names (hard links), expected one");
    std::filesystem::remove(file("hard.db"));
  }
  EXPECT_FALSE(std::filesystem::exists(file("a.db.lock")));
  Store(file("a.db")).save(some_statistics("wang"), shard, {});
}

TEST_F(StoreTest, AReaderSeesOneSave) {
  Store store(file("a.db"), info, shard);
  const std::jthread writer([&](const std::stop_token& over) {
    Statistics statistics;
    while (!over.stop_requested()) {
      statistics.merge(some_statistics("wang"));
      const Finding finding = some_finding("x");
      store.save(statistics, shard, std::span(&finding, 1));
    }
  });
  for (int i = 0; i < 100; ++i) {
    const Campaign read = load_campaign(file("a.db"));
    const auto disagreements = some_statistics("wang").oracle_disagreements;
    EXPECT_EQ(read.statistics.oracle_disagreements, disagreements * read.runs[0].findings.size());
  }
}

/// Limits the size of the files that this process writes, with the same effect as a full disk.
class NoRoom {
 public:
  explicit NoRoom(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  NoRoom(const NoRoom&) = delete;
  NoRoom& operator=(const NoRoom&) = delete;
  ~NoRoom() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST_F(StoreTest, AFullDiskLosesNothingThatWasSaved) {
  Store store(file("a.db"), info, shard);
  store.save(some_statistics("wang"), shard, {});
  const NoRoom no_room(100 << 10);
  std::vector<Finding> many;
  for (int i = 0; i < 2000; ++i) many.push_back(some_finding(std::to_string(i)));
  EXPECT_REFUSED(store.save({}, shard, many), "a.db: ");
  const Campaign campaign = load_campaign(file("a.db"));
  EXPECT_EQ(campaign.statistics, some_statistics("wang"));
  EXPECT_EQ(campaign.runs, (std::vector<nearmiss::Run>{{info, {shard}, {}}}));
}

TEST_F(StoreTest, MayHaveANameThatSqliteKnows) {
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(file(""));
  Store(":memory:", info, shard).save(some_statistics("wang"), shard, {});
  EXPECT_EQ(load_campaign(":memory:").statistics, some_statistics("wang"));
  std::filesystem::current_path(before);
}

TEST_F(StoreTest, ACampaignIsWrittenBesideItsFile) {
  const auto elsewhere = std::filesystem::current_path();
  std::filesystem::create_directories(file("here/.part/full"));  // where a temporary file might be
  std::filesystem::current_path(file("here"));
  write_campaign({}, file("a.db"));
  std::filesystem::current_path(elsewhere);
  EXPECT_TRUE(load_campaign(file("a.db")).runs.empty());
  EXPECT_FALSE(std::filesystem::exists(file("a.db.part")));
}

TEST_F(StoreTest, NeverReplacesAFileOfTheUser) {
  write("a.db", "precious");
  write("b.db.lock", "mine");
  EXPECT_REFUSED(Store(file("a.db"), info, shard), "a.db: exists already");
  EXPECT_REFUSED(write_campaign({}, file("a.db")), "a.db: exists already");
  EXPECT_REFUSED(Store(file("b.db"), info, shard), "b.db.lock: found a file with 4 bytes, expected none");
  EXPECT_EQ(read("a.db") + read("b.db.lock"), "preciousmine");
}

TEST_F(StoreTest, RefusesWhatIsNoStore) {
  write("text.db", "this is not a database, although it is long enough to be taken for one");
  Database(file("other.db")).execute("CREATE TABLE t (x)");
  Store(file("deep.db"), info, shard)
      .add({"scene", R"({"points":)" + std::string(50, '[') + std::string(50, ']') + '}'});
  for (const auto& [name, error] : {std::pair{"none.db", "no such file"},
                                    {"text.db", "file is not a database"},
                                    {"other.db", "found another kind of database"},
                                    {"deep.db", "table picture: JSON with more than 32 levels"}})
    EXPECT_REFUSED(load_campaign(file(name)), std::string(name) + ": " + error);
  EXPECT_REFUSED(Store(file("no/a.db"), info, shard), "no/a.db.lock: cannot be made");
}

}  // namespace
}  // namespace nearmiss
