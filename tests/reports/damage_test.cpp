// A damaged store is refused, or it gives the same campaign as before. A salvage takes the intact part only.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>
#include <set>

#include "ccd/error.hpp"
#include "fuzz/random.hpp"
#include "reports/store/salvage.hpp"
#include "reports/store/store.hpp"
#include "tests/reports/stored.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using testing::shard;
using testing::some_finding;
using testing::some_statistics;
using ::testing::ThrowsMessage;

class DamageTest : public testing::TemporaryFolder {
 protected:
  void execute(const std::string& name, const std::string& sql) const {
    sqlite3* db = nullptr;
    sqlite3_open(file(name).c_str(), &db);
    EXPECT_EQ(sqlite3_exec(db, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(db);
    sqlite3_close(db);
  }

  /// The number that a query gives.
  [[nodiscard]] std::int64_t ask(const std::string& name, const std::string& sql) const {
    sqlite3* db = nullptr;
    sqlite3_open(file(name).c_str(), &db);
    sqlite3_stmt* statement = nullptr;
    EXPECT_EQ(sqlite3_prepare_v2(db, sql.c_str(), -1, &statement, nullptr), SQLITE_OK) << sqlite3_errmsg(db);
    EXPECT_EQ(sqlite3_step(statement), SQLITE_ROW);
    const std::int64_t number = sqlite3_column_int64(statement, 0);
    sqlite3_finalize(statement);
    sqlite3_close(db);
    return number;
  }
};

/// A campaign with two runs, shards, statistics of several subjects, findings on several pages, and pictures.
Campaign whole_campaign() {
  std::string picture = R"({"points":[0)";
  for (int i = 0; i < 5000; ++i) picture += ",1";
  picture += "]}";
  Campaign campaign;
  for (const char* subject : {"basic", "wang", "always"}) campaign.statistics.merge(some_statistics(subject));
  for (const char* seed : {"1", "2"}) {
    Run run{{{"command", "fuzz"}, {"seed", seed}}, {shard}, {}};
    Shard other = shard;
    other.index = 3;
    run.shards.push_back(other);
    for (int i = 0; i < 20; ++i) run.findings.push_back(some_finding(std::to_string(i)));
    for (const char* step : {"scene:cloth#1", "scene:cloth#2"}) run.pictures.push_back({step, picture});
    campaign.runs.push_back(run);
  }
  for (const Finding& finding : campaign.findings()) ++campaign.statistics.seen[signature_of(finding)];
  return campaign;
}

bool is_same(const Campaign& a, const Campaign& b) {
  return a.runs == b.runs && a.statistics == b.statistics;
}

/// Expects that all of a salvaged campaign was in the whole campaign.
void expect_part(const Campaign& part, const Campaign& whole) {
  EXPECT_THAT(whole.statistics.counts, IsSupersetOf(part.statistics.counts));
  EXPECT_THAT(whole.statistics.oracle, IsSupersetOf(part.statistics.oracle));
  EXPECT_THAT(whole.statistics.funnels, IsSupersetOf(part.statistics.funnels));
  EXPECT_THAT(whole.statistics.factors, IsSupersetOf(part.statistics.factors));
  // A row that is lost is made up for by the findings that are stored.
  for (const auto& [signature, count] : part.statistics.seen)
    EXPECT_LE(count, whole.statistics.times_seen(signature));
  EXPECT_THAT(whole.statistics.extremes, IsSupersetOf(part.statistics.extremes));
  for (const Run& run : part.runs) {
    EXPECT_THAT(whole.runs[0].shards, IsSupersetOf(run.shards));
    EXPECT_THAT(whole.runs[0].findings, IsSupersetOf(run.findings));
    EXPECT_THAT(whole.runs[0].pictures, IsSupersetOf(run.pictures));
  }
}

/// 600 pseudo-random bits of a file with so many bytes, and one in each byte of its header.
std::set<std::uint64_t> some_bits(std::uint64_t bytes) {
  constexpr std::uint64_t header = 100;
  std::set<std::uint64_t> bits;
  Random random(1, 0, 0);
  for (std::uint64_t byte = 0; byte < header; ++byte) bits.insert(8 * byte + random.bits() % 8);
  while (bits.size() < 600 + header) bits.insert(random.bits() % (8 * bytes));
  return bits;
}

TEST_F(DamageTest, OfAnyBitIsNoticedOrDoesNotMatter) {
  const Campaign whole = whole_campaign();
  write_campaign(whole, file("a.db"));
  ASSERT_TRUE(is_same(load_campaign(file("a.db")), whole));
  const std::string bytes = read("a.db");
  int refused = 0;
  int harmless = 0;
  for (const std::uint64_t bit : some_bits(bytes.size())) {
    SCOPED_TRACE("bit " + std::to_string(bit) + " of " + std::to_string(8 * bytes.size()));
    std::string damaged = bytes;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
    write("b.db", damaged);
    try {
      EXPECT_TRUE(is_same(load_campaign(file("b.db")), whole));
      ++harmless;
      continue;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      ++refused;
    }
    try {
      const Salvage salvage = salvage_campaign(file("b.db"));
      expect_part(salvage.campaign, whole);
      EXPECT_EQ(salvage.lost.empty(), is_same(salvage.campaign, whole)) << salvage.lost;
    } catch (const Error&) {  // nothing can be saved
    }
  }
  RecordProperty("refused", refused);
  RecordProperty("harmless", harmless);
  EXPECT_GT(refused, 200);
  EXPECT_GT(harmless, 0);
}

TEST_F(DamageTest, OfARowIsRefusedAndTheOthersAreSaved) {
  const Campaign whole = whole_campaign();
  write_campaign(whole, file("a.db"));
  execute("a.db",
          "UPDATE finding SET ratio = 0.5 WHERE number = 7; UPDATE counts SET false_negatives = 9 "
          "WHERE subject = 'wang'");
  const std::string lost = "1 of 40 rows of finding, 1 of 3 rows of counts";
  EXPECT_THAT([&] { load_campaign(file("a.db")); },
              ThrowsMessage<Error>(AllOf(
                  HasSubstr("a.db: damaged: a row of table finding does not match its checksum; nearmiss "
                            "merge NEW.db "),
                  EndsWith("a.db --salvage saves 74 rows, without " + lost))));
  Salvage salvage = salvage_campaign(file("a.db"));
  EXPECT_EQ(salvage.lost, lost);
  Campaign expected = whole;
  expected.statistics.counts.erase({"wang", Kind::edge_edge, "uniform"});
  std::erase_if(expected.runs[0].findings, [](const Finding& f) { return f.provenance == "6"; });
  for (nearmiss::Run& run : expected.runs) run.info[salvaged_fact] = "lost " + lost;
  EXPECT_EQ(salvage.campaign.runs, expected.runs);
  EXPECT_EQ(salvage.campaign.statistics, expected.statistics);
}

TEST_F(DamageTest, OfTheVersionDoesNotKeepFromSalvage) {
  const Campaign whole = whole_campaign();
  write_campaign(whole, file("a.db"));
  execute("a.db", "PRAGMA user_version = 79; PRAGMA application_id = 1");
  EXPECT_THAT([&] { load_campaign(file("a.db")); },
              ThrowsMessage<Error>(HasSubstr("another kind of database")));
  const Salvage salvage = salvage_campaign(file("a.db"));
  EXPECT_EQ(salvage.lost, "");
  EXPECT_EQ(salvage.campaign.runs, whole.runs);
}

TEST_F(DamageTest, AFindingWasSeenAtLeastOnce) {
  Campaign whole = whole_campaign();
  for (const Finding& finding : whole.findings()) whole.statistics.seen[signature_of(finding)] = 1000;
  write_campaign(whole, file("a.db"));
  execute("a.db", "DELETE FROM seen");
  const Campaign part = salvage_campaign(file("a.db")).campaign;
  std::map<Signature, std::uint64_t> stored;
  for (const Finding& finding : part.findings()) ++stored[signature_of(finding)];
  EXPECT_FALSE(stored.empty());
  EXPECT_EQ(part.statistics.seen, stored);
}

TEST_F(DamageTest, ALostRowIsMissed) {
  write_campaign(whole_campaign(), file("a.db"));
  execute("a.db", "DELETE FROM finding WHERE number = 40");
  EXPECT_THAT([&] { load_campaign(file("a.db")); },
              ThrowsMessage<Error>(HasSubstr("found 39 rows of table finding, expected 40")));
  EXPECT_EQ(salvage_campaign(file("a.db")).lost, "1 of 40 rows of finding");
}

TEST_F(DamageTest, ARowOfAnEarlierSaveIsNoticed) {
  for (const char* name : {"old.db", "new.db"})
    Store(file(name), testing::info, shard).save(some_statistics("wang"), shard, {});
  Statistics later = some_statistics("wang");
  later.merge(some_statistics("wang"));
  Store(file("new.db")).save(later, shard, {});
  execute("new.db", "ATTACH '" + file("old.db").string() +
                        "' AS old; INSERT OR REPLACE INTO counts SELECT * FROM old.counts");
  EXPECT_THAT([&] { load_campaign(file("new.db")); },
              ThrowsMessage<Error>(HasSubstr("the rows of table counts are not those of the last save")));
}

TEST_F(DamageTest, OfAnIndexStopsWriting) {
  Store(file("a.db"), testing::info, shard).save(some_statistics("wang"), shard, {});
  const auto page = static_cast<std::size_t>(
      ask("a.db", "SELECT rootpage FROM sqlite_schema WHERE name = 'sqlite_autoindex_counts_1'"));
  const auto size = static_cast<std::size_t>(ask("a.db", "PRAGMA page_size"));
  std::string bytes = read("a.db");
  const std::size_t key = bytes.rfind("wang", size * page);
  ASSERT_GT(key, size * (page - 1));
  bytes[key] = 'v';
  write("a.db", bytes);
  EXPECT_EQ(load_campaign(file("a.db")).statistics, some_statistics("wang"));
  EXPECT_THAT([&] { Store(file("a.db")); },
              ThrowsMessage<Error>(AllOf(HasSubstr("a.db: damaged: row 1 missing from index"),
                                         EndsWith("--salvage saves 14 rows, without any loss"))));
  EXPECT_EQ(read("a.db"), bytes);
}

TEST_F(DamageTest, ACutFileGivesTheRowsBeforeTheCut) {
  const Campaign whole = whole_campaign();
  write_campaign(whole, file("a.db"));
  const std::string bytes = read("a.db");
  write("a.db", bytes.substr(0, bytes.size() / 2));
  const Salvage salvage = salvage_campaign(file("a.db"));
  expect_part(salvage.campaign, whole);
  EXPECT_GT(salvage.rows, 0);
  EXPECT_THAT(salvage.lost, HasSubstr(" rows of "));
  write("a.db", bytes.substr(0, 50));
  EXPECT_THAT([&] { salvage_campaign(file("a.db")); }, ThrowsMessage<Error>(HasSubstr("a.db: ")));
}

TEST_F(DamageTest, ARunWithoutItsFactsIsSaved) {
  Campaign whole = whole_campaign();
  whole.runs.pop_back();
  write_campaign(whole, file("a.db"));
  execute("a.db", "UPDATE run SET info = '{}'");
  const Campaign saved = salvage_campaign(file("a.db")).campaign;
  ASSERT_EQ(saved.runs.size(), 1);
  EXPECT_EQ(saved.runs[0].info, (RunInfo{{"command", "unknown"},
                                         {salvaged_fact, "lost 1 of 1 rows of run"},
                                         {origin_fact, "partly unknown"}}));
  EXPECT_EQ(saved.runs[0].findings, whole.runs[0].findings);
}

TEST_F(DamageTest, ASalvageIsNotMergedWithItsOriginal) {
  write_campaign(whole_campaign(), file("a.db"));
  execute("a.db", "DELETE FROM seen");
  const std::array<Campaign, 2> both{whole_campaign(), salvage_campaign(file("a.db")).campaign};
  const std::array<std::string, 2> names{"whole.db", "salvaged.db"};
  EXPECT_THAT([&] { merge_campaigns(both, names); },
              ThrowsMessage<Error>(AllOf(HasSubstr("whole.db and salvaged.db: both have shard "),
                                         Not(HasSubstr("salvaged lost")))));
}

TEST_F(DamageTest, WithoutItsRunIsNotMerged) {
  write_campaign(whole_campaign(), file("a.db"));
  execute("a.db", "DELETE FROM shard");
  const std::array<Campaign, 2> both{whole_campaign(), salvage_campaign(file("a.db")).campaign};
  const std::array<std::string, 2> names{"whole.db", "salvaged.db"};
  EXPECT_THAT([&] { merge_campaigns(both, names); },
              ThrowsMessage<Error>(HasSubstr("salvaged.db: found results of an unknown run")));
  merge_campaigns(std::span(both).last(1), std::span(names).last(1));
}

}  // namespace
}  // namespace nearmiss
