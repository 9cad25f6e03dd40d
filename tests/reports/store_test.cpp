// Whatever happens after a save, the store has all saved results.
#include "reports/store/store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/resource.h>

#include <csignal>

#include "ccd/error.hpp"
#include "tests/queries.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class StoreTest : public testing::TemporaryFolder {};

TEST_F(StoreTest, AKillDuringItsCreationLeavesNoStore) {
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(file("a.db").c_str(), &db), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(db, "PRAGMA journal_mode = WAL", nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(db);
  EXPECT_GT(std::filesystem::file_size(file("a.db")), 0);
  EXPECT_FALSE(Store::exists(file("a.db")));
  { const Store store(file("a.db"), {{"command", "fuzz"}}, {}); }
  EXPECT_TRUE(Store::exists(file("a.db")));
  EXPECT_THAT(
      [&] {
        Store(file("a.db"), {{"command", "fuzz"}}, {});
      },
      ThrowsMessage<Error>(HasSubstr("a.db: exists already")));
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

const Query query = testing::falling_edge(0.1, -1.0 / 3);

Statistics some_statistics(const std::string& subject) {
  Statistics statistics;
  Counts& counts = statistics.counts[{subject, Kind::edge_edge, "uniform"}];
  counts.add({.verdict = {true, Stage::ve_minimum, 0.5}, .collision = true}, query,
             [] { return "uniform:1:1"; });
  counts.add({.verdict = {true, Stage::vv, 0.5}, .collision = false, .ratio = 0.1}, query,
             [] { return "uniform:1:3"; });
  counts.add({.verdict = Verdict::rejected(Rejection::culled)}, query, [] { return "uniform:1:5"; });
  counts.times.add(Kind::edge_edge, "uniform", {3, 99});
  OracleCounts& oracle = statistics.oracle[{Kind::edge_edge, "uniform"}];
  oracle.queries = 2;
  oracle.collisions = 1;
  oracle.by_stage[2] = 2;
  oracle.near_bounds = 2;
  counts.faults = {0, 1, 2, 3, 4};
  for (const std::uint64_t time : {100U, 3U, 7000U}) counts.times.add(time, query, [] { return "slow"; });
  oracle.compared = 1;
  oracle.compared_collisions = 1;
  oracle.missed_by_parity = 1;
  statistics.extremes["mu"] = {Extreme::Of::accepting_tolerance, "mu", 1.0 / 3, query, "uniform:1:3", 7};
  statistics.extremes["tau"] = nothing_found(Extreme::Of::keeping_tolerance, "tau");
  statistics.funnels[{"scene:cloth#3", Kind::edge_edge}] = {{1, 2, 3, 4, 5}, 6, 7, 8};
  statistics.seen[{Finding::What::false_negative, subject, "ee simple-root inside crossing"}] = 5;
  statistics.oracle_disagreements = 3;
  statistics.mismatches_with_recorded_truth = 4;
  return statistics;
}

/// A finding. Findings whose provenances have the same length are shrunk to the same query.
Finding some_finding(const std::string& provenance) {
  return {Finding::What::false_negative,
          "basic",
          "uniform",
          query,
          provenance,
          0,
          "ee simple-root inside crossing",
          testing::falling_edge(static_cast<double>(provenance.size()), -1),
          7};
}

const RunInfo info{{"command", "fuzz"}, {"seed", "1"}};
const Shard shard{.index = 2,
                  .count = 5,
                  .cases = 77,
                  .complete = true,
                  .started = "2026-01-02T03:04:05Z",
                  .seconds = 12.5,
                  .environment = {{"cpu", "some"}}};

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

TEST_F(StoreTest, IsWrittenByOneAtATime) {
  {
    Store store(file("a.db"), info, shard);
    EXPECT_THAT([&] { Store(file("a.db")); },
                ThrowsMessage<Error>(HasSubstr("a.db: another process is writing it")));
  }
  EXPECT_FALSE(std::filesystem::exists(file("a.db.lock")));
  Store(file("a.db")).save(some_statistics("wang"), shard, {});
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
  write_campaign({}, file("old.db"));
  sqlite3* db = nullptr;
  sqlite3_open(file("old.db").c_str(), &db);
  sqlite3_exec(db, "PRAGMA user_version = 7", nullptr, nullptr, nullptr);
  sqlite3_close(db);
  EXPECT_THAT([&] { load_campaign(file("old.db")); },
              ThrowsMessage<Error>(HasSubstr("old.db: found store version 7, expected 13")));
}

TEST_F(StoreTest, AFolderThatIsNotThere) {
  EXPECT_THAT([&] { Store(file("no/a.db"), info, shard); },
              ThrowsMessage<Error>(HasSubstr("no/a.db.lock: cannot be made")));
}

}  // namespace
}  // namespace nearmiss
