// Whatever happens after a save, the store has all saved results.
#include "reports/store/store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/resource.h>

#include <csignal>
#include <thread>

#include "ccd/error.hpp"
#include "tests/reports/stored.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

using ::testing::HasSubstr;
using testing::info;
using testing::shard;
using testing::some_finding;
using testing::some_statistics;
using ::testing::ThrowsMessage;

class StoreTest : public testing::TemporaryFolder {};

TEST_F(StoreTest, AKillDuringItsCreationLeavesNoStore) {
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(file("a.db").c_str(), &db), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(db, "PRAGMA journal_mode = WAL", nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(db);
  EXPECT_GT(std::filesystem::file_size(file("a.db")), 0);
  EXPECT_FALSE(Store::exists(file("a.db")));
  EXPECT_THAT([&] { load_campaign(file("a.db")); },
              ThrowsMessage<Error>(HasSubstr("a.db: found an empty database")));
  { const Store store(file("a.db"), {{"command", "fuzz"}}, {}); }
  EXPECT_TRUE(Store::exists(file("a.db")));
  EXPECT_THAT(
      [&] {
        Store(file("a.db"), {{"command", "fuzz"}}, {});
      },
      ThrowsMessage<Error>(HasSubstr("a.db: exists already")));
}

TEST_F(StoreTest, AKillDuringAChangeOfTheFileItselfIsTakenBack) {
  { Store(file("a.db"), info, shard).save(some_statistics("wang"), shard, {}); }
  std::filesystem::create_directory(file("killed"));
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(file("a.db").c_str(), &db), SQLITE_OK);
  // Without a cache, the change is in the file before it is committed, as after a kill.
  const char* const half_a_change =
      "PRAGMA cache_size = 0; BEGIN IMMEDIATE; DELETE FROM shard; PRAGMA user_version = 1;"
      "CREATE TABLE other AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n LIMIT 9999) "
      "SELECT i FROM n";
  ASSERT_EQ(sqlite3_exec(db, half_a_change, nullptr, nullptr, nullptr), SQLITE_OK);
  for (const char* name : {"a.db", "a.db-journal"}) copy_file(file(name), file("killed") / name);
  sqlite3_close(db);
  ASSERT_NE(read("a.db"), read("killed/a.db"));
  create_symlink(file("killed") / "a.db", file("link.db"));
  EXPECT_EQ(load_campaign(file("link.db")).statistics, some_statistics("wang"));
  EXPECT_EQ(read("a.db"), read("killed/a.db"));
}

TEST_F(StoreTest, AFileOfAnotherKindIsNotReplaced) {
  write("a.db", "precious");
  EXPECT_THAT(
      [&] {
        Store(file("a.db"), {{"command", "fuzz"}}, {});
      },
      ThrowsMessage<Error>(HasSubstr("a.db: exists already")));
  EXPECT_EQ(read("a.db"), "precious");
}

TEST_F(StoreTest, GivesBackWhatWasSaved) {
  const std::vector findings{some_finding("uniform:1:5"), some_finding("uniform:1:3")};
  {
    Shard before = shard;
    before.cases = 3;
    Store store(file("a.db"), info, before);
    store.save({}, before, std::span(findings).first(1));
    store.save(some_statistics("wang"), shard, std::span(findings).last(1));
    store.add({"scene:cloth", R"({"points":[1,2]})"});
  }
  const Campaign campaign = load_campaign(file("a.db"));
  EXPECT_EQ(campaign.statistics, some_statistics("wang"));
  const std::vector<ScenePicture> pictures{{"scene:cloth", R"({"points":[1,2]})"}};
  EXPECT_EQ(campaign.runs, (std::vector<nearmiss::Run>{{info, {shard}, findings, pictures}}));
  write_campaign(campaign, file("copy.db"));
  EXPECT_EQ(load_campaign(file("copy.db")).runs, campaign.runs);
}

TEST_F(StoreTest, CanBeReadWhileItIsWritten) {
  Store store(file("a.db"), info, shard);
  store.save(some_statistics("wang"), shard, {});
  EXPECT_EQ(load_campaign(file("a.db")).statistics, some_statistics("wang"));
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

TEST_F(StoreTest, WaitsForReadersWhenItIsOpened) {
  { Store(file("a.db"), info, shard).save(some_statistics("wang"), shard, {}); }
  sqlite3* reader = nullptr;
  ASSERT_EQ(sqlite3_open(file("a.db").c_str(), &reader), SQLITE_OK);
  const auto run = [&](const char* command) {
    EXPECT_EQ(sqlite3_exec(reader, command, nullptr, nullptr, nullptr), SQLITE_OK);
  };
  run("BEGIN; SELECT count(*) FROM shard");
  std::jthread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    run("COMMIT");
  });
  Store(file("a.db")).save(some_statistics("wang"), shard, {});
  later.join();
  sqlite3_close(reader);
  EXPECT_EQ(load_campaign(file("a.db")).statistics, some_statistics("wang"));
}

TEST_F(StoreTest, IsWrittenByOneAtATime) {
  {
    Store store(file("a.db"), info, shard);
    EXPECT_THAT([&] { Store(file("a.db")); },
                ThrowsMessage<Error>(HasSubstr("a.db: another process is writing it")));
  }
  EXPECT_FALSE(std::filesystem::exists(file("a.db.lock")));
  Store(file("a.db")).save(some_statistics("wang"), shard, {});
}

TEST_F(StoreTest, ALockDoesNotReplaceAFileOfTheUser) {
  write("a.db.lock", "mine");
  EXPECT_THAT([&] { Store(file("a.db"), {}, {}); },
              ThrowsMessage<Error>(HasSubstr("a.db.lock: found a file with 4 bytes, expected none")));
  EXPECT_EQ(read("a.db.lock"), "mine");
}

TEST_F(StoreTest, IsOneStoreUnderEachOfItsNames) {
  Store store(file("a.db"), info, shard);
  std::filesystem::create_symlink(file("a.db"), file("link.db"));
  EXPECT_THAT([&] { Store(file("link.db")); },
              ThrowsMessage<Error>(HasSubstr("link.db: another process is writing it")));
  std::filesystem::create_hard_link(file("a.db"), file("hard.db"));
  EXPECT_THAT(
      [&] { Store(file("hard.db")); },
      ThrowsMessage<Error>(HasSubstr("hard.db: found a file with 2 names (hard links), expected one")));
}

TEST_F(StoreTest, GoesOn) {
  const Finding first = some_finding("first");
  const Finding second = some_finding("second");
  Store(file("a.db"), info, shard).save({}, shard, std::span(&first, 1));
  Shard later = shard;
  later.cases = 78;
  Store(file("a.db")).save(some_statistics("wang"), later, std::span(&second, 1));
  const Campaign campaign = load_campaign(file("a.db"));
  EXPECT_EQ(campaign.runs, (std::vector<nearmiss::Run>{{info, {later}, {first, second}, {}}}));
  EXPECT_EQ(campaign.statistics, some_statistics("wang"));
}

TEST_F(StoreTest, ReplacesItsFindings) {
  const std::vector<Finding> findings{some_finding("first"), some_finding("second"), some_finding("third")};
  Store store(file("a.db"), info, shard);
  store.save({}, shard, findings);
  store.replace(std::span(findings).last(1));
  store.save({}, shard, std::span(findings).first(1));
  EXPECT_EQ(load_campaign(file("a.db")).runs[0].findings, (std::vector{findings[2], findings[0]}));
}

TEST_F(StoreTest, GoesOnWithOnePartOfOneRunOnly) {
  Shard other = shard;
  other.index = 3;
  write_campaign({{{info, {shard, other}, {}, {}}}, {}}, file("a.db"));
  EXPECT_THAT([&] { Store(file("a.db")); }, ThrowsMessage<Error>(HasSubstr("a.db: found several shards")));
  EXPECT_THAT([&] { Store(file("none.db")); }, ThrowsMessage<Error>(HasSubstr("none.db: unable to open")));
}

/// Limits the size of this process's files, which has the same effect as a full disk.
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
  EXPECT_THAT([&] { store.save({}, shard, many); }, ThrowsMessage<Error>(HasSubstr("a.db: ")));
  const Campaign campaign = load_campaign(file("a.db"));
  EXPECT_EQ(campaign.statistics, some_statistics("wang"));
  EXPECT_EQ(campaign.runs, (std::vector<nearmiss::Run>{{info, {shard}, {}}}));
}

TEST_F(StoreTest, AMergedCampaignIsTheSameInAFile) {
  const Campaign campaign{{{info, {shard}, {some_finding("x")}}, {{{"seed", "2"}}, {}, {some_finding("y")}}},
                          some_statistics("wang")};
  write_campaign(campaign, file("a.db"));
  const Campaign again = load_campaign(file("a.db"));
  EXPECT_EQ(again.runs, campaign.runs);
  EXPECT_EQ(again.statistics, campaign.statistics);
}

TEST_F(StoreTest, ACampaignIsWrittenBesideItsFile) {
  const auto elsewhere = std::filesystem::current_path();
  std::filesystem::create_directories(file("here/.part/full"));  // in the way of a file of that name
  std::filesystem::current_path(file("here"));
  write_campaign({}, file("a.db"));
  std::filesystem::current_path(elsewhere);
  EXPECT_TRUE(load_campaign(file("a.db")).runs.empty());
  EXPECT_FALSE(std::filesystem::exists(file("a.db.part")));
}

TEST_F(StoreTest, ACutFileIsRefused) {
  write_campaign({{{info, {shard}, {some_finding("x")}}}, some_statistics("wang")}, file("a.db"));
  const std::string whole = read("a.db");
  for (const std::size_t size : {std::size_t{0}, std::size_t{50}, whole.size() / 2, whole.size() - 4096}) {
    write("cut.db", whole.substr(0, size));
    EXPECT_THAT([&] { load_campaign(file("cut.db")); }, ThrowsMessage<Error>(HasSubstr("cut.db: "))) << size;
  }
}

TEST_F(StoreTest, NeverTakesAFileThatIsThereAlready) {
  write("a.db", "precious");
  EXPECT_THAT([&] { Store(file("a.db"), info, shard); },
              ThrowsMessage<Error>(HasSubstr("a.db: exists already")));
  EXPECT_THAT([&] { write_campaign({}, file("a.db")); },
              ThrowsMessage<Error>(HasSubstr("a.db: exists already")));
  EXPECT_EQ(read("a.db"), "precious");
}

TEST_F(StoreTest, RefusesWhatIsNoStore) {
  EXPECT_THAT([&] { load_campaign(file("a.db")); }, ThrowsMessage<Error>(HasSubstr("a.db: no such file")));
  write("text.db", "this is not a database, although it is long enough to be taken for one");
  EXPECT_THAT([&] { load_campaign(file("text.db")); },
              ThrowsMessage<Error>(HasSubstr("text.db: file is not a database")));
  sqlite3* other = nullptr;
  sqlite3_open(file("other.db").c_str(), &other);
  sqlite3_exec(other, "CREATE TABLE t (x)", nullptr, nullptr, nullptr);
  sqlite3_close(other);
  EXPECT_THAT([&] { load_campaign(file("other.db")); },
              ThrowsMessage<Error>(HasSubstr("expected a store of nearmiss")));
}

TEST_F(StoreTest, RefusesAnotherVersion) {
  write_campaign({}, file("other.db"));
  for (const std::string version : {"7", "18", "20"}) {
    sqlite3* db = nullptr;
    sqlite3_open(file("other.db").c_str(), &db);
    sqlite3_exec(db, ("PRAGMA user_version = " + version).c_str(), nullptr, nullptr, nullptr);
    sqlite3_close(db);
    const auto refused = ThrowsMessage<Error>(
        ::testing::EndsWith("other.db: found store version " + version + ", expected 19"));
    EXPECT_THAT([&] { load_campaign(file("other.db")); }, refused);
    EXPECT_THAT([&] { Store(file("other.db")); }, refused);
  }
}

TEST_F(StoreTest, AFolderThatIsNotThere) {
  EXPECT_THAT([&] { Store(file("no/a.db"), info, shard); },
              ThrowsMessage<Error>(HasSubstr("no/a.db.lock: cannot be made")));
}

}  // namespace
}  // namespace nearmiss
