// The store: what is saved is there, whole, whatever happens next.
#include "reports/store.hpp"

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

const Query query = testing::falling_edge(0.1, -1.0 / 3);

Statistics some_statistics(const std::string& subject) {
  Statistics statistics;
  Counts& counts = statistics.counts[{subject, Kind::edge_edge, "uniform"}];
  counts.add({.verdict = {true, Stage::ve_minimum, 0.5}, .collision = true}, query,
             [] { return "uniform:1:1"; });
  counts.add({.verdict = {true, Stage::vv, 0.5}, .collision = false, .ratio = 0.1}, query,
             [] { return "uniform:1:3"; });
  counts.timed_queries = 2;
  counts.nanoseconds = 99;
  OracleCounts& oracle = statistics.oracle[{Kind::edge_edge, "uniform"}];
  oracle.queries = 2;
  oracle.collisions = 1;
  oracle.by_stage[2] = 2;
  oracle.near_bounds = 2;
  oracle.compared = 1;
  oracle.compared_collisions = 1;
  oracle.missed_by_parity = 1;
  statistics.extremes["mu"] = {Extreme::Of::accepting_tolerance, "mu", 1.0 / 3, query, "uniform:1:3", 7};
  statistics.extremes["tau"] = nothing_found(Extreme::Of::keeping_tolerance, "tau");
  statistics.seen[{Finding::What::false_negative, subject, "ee simple-root inside crossing"}] = 5;
  statistics.oracle_disagreements = 3;
  statistics.mismatches_with_recorded_truth = 4;
  return statistics;
}

/// A finding; those with provenances of one length are shrunk to the same query.
Finding some_finding(const std::string& provenance) {
  return {Finding::What::false_negative,
          "basic",
          "uniform",
          query,
          provenance,
          0,
          "ee simple-root inside crossing",
          testing::falling_edge(static_cast<double>(provenance.size()), -1)};
}

TEST_F(StoreTest, GivesBackWhatWasSaved) {
  const Finding finding = some_finding("uniform:1:5");
  {
    const RunInfo run{{"command", "fuzz"}, {"seed", "1"}};
    Store store(file("a.db"), std::span(&run, 1));
    store.save(some_statistics("wang"), {});
    store.save(some_statistics("wang"), std::span(&finding, 1));
  }
  const Campaign campaign = load_campaign(file("a.db"));
  EXPECT_EQ(campaign.statistics, some_statistics("wang"));
  EXPECT_EQ(campaign.findings, std::vector{finding});
  EXPECT_EQ(campaign.runs, (std::vector<RunInfo>{{{"command", "fuzz"}, {"seed", "1"}}}));
}

TEST_F(StoreTest, CanBeReadWhileItIsWritten) {
  Store store(file("a.db"), {});
  store.save(some_statistics("wang"), {});
  EXPECT_EQ(load_campaign(file("a.db")).statistics, some_statistics("wang"));
}

/// No file of this process can grow beyond a size: to a writer the same as a full disk.
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
  Store store(file("a.db"), {});
  store.save(some_statistics("wang"), {});
  const NoRoom no_room(100 << 10);
  std::vector<Finding> many;
  for (int i = 0; i < 2000; ++i) many.push_back(some_finding(std::to_string(i)));
  EXPECT_THAT([&] { store.save({}, many); }, ThrowsMessage<Error>(HasSubstr("a.db: ")));
  const Campaign campaign = load_campaign(file("a.db"));
  EXPECT_EQ(campaign.statistics, some_statistics("wang"));
  EXPECT_TRUE(campaign.findings.empty());
}

TEST_F(StoreTest, MergingDoesNotDependOnTheOrder) {
  const auto campaign = [](const std::string& subject, const std::string& seed,
                           const std::string& provenance) {
    return Campaign{
        {{{"seed", seed}}}, some_statistics(subject), {some_finding(provenance), some_finding("both")}};
  };
  const std::vector campaigns{campaign("wang", "1", "x"), campaign("basic", "2", "yy"),
                              campaign("wang", "3", "zzz")};
  std::vector reversed(campaigns.rbegin(), campaigns.rend());
  const Campaign merged = merge_campaigns(campaigns);
  write_campaign(merged, file("a.db"));
  write_campaign(merge_campaigns(reversed), file("b.db"));
  EXPECT_EQ(read("a.db"), read("b.db"));
  EXPECT_EQ(merged.findings.size(), 4);
  EXPECT_EQ(merged.runs.size(), 3);
  const Campaign again = load_campaign(file("a.db"));
  EXPECT_EQ(again.statistics, merged.statistics);
  EXPECT_EQ(again.findings, merged.findings);
  EXPECT_EQ(again.runs, merged.runs);
}

TEST_F(StoreTest, MergingKeepsOneOfThoseThatAreShrunkToTheSame) {
  const auto campaign = [](const std::string& provenance) {
    return Campaign{{}, some_statistics("basic"), {some_finding(provenance)}};
  };
  const std::vector campaigns{campaign("c"), campaign("a"), campaign("bb"), campaign("b")};
  std::vector reversed(campaigns.rbegin(), campaigns.rend());
  const Campaign merged = merge_campaigns(campaigns);
  EXPECT_EQ(merged.findings, (std::vector{some_finding("a"), some_finding("bb")}));
  EXPECT_EQ(merge_campaigns(reversed).findings, merged.findings);
  EXPECT_EQ(merged.statistics.seen.begin()->second, 20);
  // In steps too.
  const std::vector halves{merge_campaigns(std::span(campaigns).first(2)),
                           merge_campaigns(std::span(campaigns).last(2))};
  EXPECT_EQ(merge_campaigns(halves).findings, merged.findings);
}

TEST_F(StoreTest, NeverTakesAFileThatIsThereAlready) {
  write("a.db", "precious");
  EXPECT_THAT([&] { Store(file("a.db"), {}); }, ThrowsMessage<Error>(HasSubstr("a.db: exists already")));
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
  sqlite3_exec(db, "PRAGMA user_version = 3", nullptr, nullptr, nullptr);
  sqlite3_close(db);
  EXPECT_THAT([&] { load_campaign(file("old.db")); },
              ThrowsMessage<Error>(HasSubstr("old.db: found store version 3, expected 4")));
}

TEST_F(StoreTest, AFolderThatIsNotThere) {
  EXPECT_THAT([&] { Store(file("no/a.db"), {}); },
              ThrowsMessage<Error>(HasSubstr("no/a.db: unable to open")));
}

}  // namespace
}  // namespace nearmiss
