// If a store is damaged, loading it either fails or gives the whole campaign. A salvage takes only the intact
// part of the store.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "ccd/query/error.hpp"
#include "fuzz/random.hpp"
#include "reports/store/store.hpp"
#include "reports/store/table.hpp"
#include "tests/refused.hpp"
#include "tests/reports/stored.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

using ::testing::AllOf;
using testing::Database;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using testing::shard;
using testing::some_finding;
using testing::some_statistics;

/// A campaign with two runs, shards, several subjects, pictures, and findings that fill pages of the file.
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

/// Expects that everything in a salvaged campaign was in the whole campaign.
void expect_part(const Campaign& part, const Campaign& whole) {
  EXPECT_THAT(whole.statistics.counts, IsSupersetOf(part.statistics.counts));
  EXPECT_THAT(whole.statistics.oracle, IsSupersetOf(part.statistics.oracle));
  EXPECT_THAT(whole.statistics.funnels, IsSupersetOf(part.statistics.funnels));
  EXPECT_THAT(whole.statistics.simulated, IsSupersetOf(part.statistics.simulated));
  EXPECT_THAT(whole.statistics.factors, IsSupersetOf(part.statistics.factors));
  EXPECT_THAT(whole.statistics.versions, IsSupersetOf(part.statistics.versions));
  EXPECT_THAT(whole.statistics.extremes, IsSupersetOf(part.statistics.extremes));
  // If the row with a signature's count is lost, the stored findings with this signature are counted instead.
  // There may be fewer stored findings than the lost row has counted.
  for (const auto& [signature, count] : part.statistics.seen)
    EXPECT_LE(count, whole.statistics.times_seen(signature));
  for (const Run& run : part.runs) {
    EXPECT_THAT(whole.runs[0].shards, IsSupersetOf(run.shards));
    EXPECT_THAT(whole.runs[0].findings, IsSupersetOf(run.findings));
    EXPECT_THAT(whole.runs[0].pictures, IsSupersetOf(run.pictures));
  }
}

class DamageTest : public testing::TemporaryFolder {
 protected:
  DamageTest() { write_campaign(whole, file("a.db")); }

  /// Expects that loading a file gives the whole campaign, or an error message of one line. If there is
  /// an error, expects that a salvage gives only parts of the campaign. Returns whether loading fails.
  bool is_refused(const std::string& name) const {
    try {
      EXPECT_TRUE(is_same(load_campaign(file(name)), whole));
      return false;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
    try {
      const Salvage salvage = salvage_campaign(file(name));
      expect_part(salvage.campaign, whole);
      EXPECT_EQ(salvage.lost.empty(), is_same(salvage.campaign, whole)) << salvage.lost;
    } catch (const Error&) {  // the salvage has found nothing to save
    }
    return true;
  }

  const Campaign whole = whole_campaign();
};

TEST_F(DamageTest, OfAnyBitIsNoticedOrDoesNotMatter) {
  const std::string bytes = read("a.db");
  std::set<std::uint64_t> bits;  // a bit in every second byte of the header, and 200 other bits
  Random random(1, 0, 0);
  constexpr std::uint64_t header = 100;
  for (std::uint64_t byte = 0; byte < header; byte += 2) bits.insert(8 * byte + random.bits() % 8);
  while (bits.size() < header / 2 + 200) bits.insert(random.bits() % (8 * bytes.size()));
  int refused = 0;
  for (const std::uint64_t bit : bits) {
    SCOPED_TRACE("bit " + std::to_string(bit) + " of " + std::to_string(8 * bytes.size()));
    std::string damaged = bytes;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
    write("b.db", damaged);
    refused += is_refused("b.db") ? 1 : 0;
  }
  EXPECT_GT(refused, 70);
  EXPECT_LT(refused, bits.size());
}

TEST_F(DamageTest, OfARowOfAnyTableIsRefusedAndTheOthersAreSaved) {
  for (const char* lost :
       {"1 of 2 rows of run", "1 of 4 rows of shard", "1 of 40 rows of finding", "1 of 4 rows of picture",
        "1 of 1 rows of campaign", "1 of 3 rows of counts", "1 of 1 rows of oracle", "1 of 1 rows of funnel",
        "1 of 12 rows of factor", "1 of 3 rows of simulated", "1 of 3 rows of version", "1 of 3 rows of seen",
        "1 of 2 rows of extreme"}) {
    const std::string words = lost;
    copy_file(file("a.db"), file("b.db"), std::filesystem::copy_options::overwrite_existing);
    Database(file("b.db"))
        .execute("UPDATE " + words.substr(words.rfind(' ')) +
                 " SET value = replace(value, '1', '2') || ' ' WHERE rowid = 1");
    EXPECT_ERROR(
        load_campaign(file("b.db")),
        AllOf(HasSubstr("b.db: damaged: some rows are not as they were saved; nearmiss merge NEW.db "),
              EndsWith("b.db --salvage saves 78 rows, without " + words)));
    EXPECT_TRUE(is_refused("b.db"));
    EXPECT_EQ(salvage_campaign(file("b.db")).lost, words);
  }
}

/// A change to a store, the error that it causes, and what a salvage reports as lost.
struct Change {
  std::string sql;
  std::string error;
  std::string lost;
};

Change of_version(int version) {
  const std::string found = std::to_string(version);
  return {"PRAGMA user_version = " + found,
          "a.db: found store version " + found + ", expected " + std::to_string(store_version), ""};
}

/// SQL that makes nested views: each view joins the previous one with itself. With each further view,
/// SQLite's work to expand the last view doubles, but the file hardly grows.
std::string nested_views() {
  std::string sql = "CREATE VIEW v0 AS SELECT 1 AS a";
  for (int i = 1; i < 64; ++i) {
    const std::string before = "v" + std::to_string(i - 1);
    sql += "; CREATE VIEW v" + std::to_string(i) + " AS SELECT x.a FROM " + before + " x, " + before + " y";
  }
  return sql;
}

TEST_F(DamageTest, OfOtherSortsIsRefused) {
  for (const auto& [sql, error, lost] :
       {Change{"DELETE FROM finding WHERE rowid = 40", "some rows are not as they were saved",
               "1 of 40 rows of finding"},
        Change{"DELETE FROM contents WHERE key = '\"seen\"'", "some rows are not as they were saved",
               "an unknown number of rows of seen"},
        Change{"INSERT INTO seen VALUES ('', '', 0)", "some rows are not as they were saved",
               "the last save of seen"},
        Change{"CREATE VIEW v AS SELECT * FROM run", "found other tables than those of a store", ""},
        Change{nested_views(), "found other tables than those of a store", ""},
        Change{"CREATE TRIGGER t INSERT ON run BEGIN DELETE FROM run; END",
               "found other tables than those of a store", ""},
        // The next two changes replace the table `seen`. The first change puts a view with endlessly many
        // rows in its place, and the second puts a table with large computed values there.
        Change{"DROP TABLE seen; CREATE VIEW seen AS WITH RECURSIVE r(n) AS (SELECT 1 UNION ALL SELECT n "
               "FROM r) "
               "SELECT n AS rowid, n AS key, n AS value, n AS checksum FROM r",
               "found other tables than those of a store", "3 of 3 rows of seen"},
        Change{"DROP TABLE seen; CREATE TABLE seen (key TEXT NOT NULL PRIMARY KEY, v TEXT, checksum INTEGER, "
               "value TEXT AS (zeroblob(60000000)))",
               "found other tables than those of a store", "3 of 3 rows of seen"},
        Change{"ALTER TABLE seen RENAME COLUMN value TO v", "found other tables than those of a store",
               "3 of 3 rows of seen"},
        of_version(store_version - 1), of_version(store_version + 1),
        Change{"PRAGMA application_id = 1", "found another kind of database, expected a store of nearmiss",
               ""}}) {
    SCOPED_TRACE(sql);
    std::filesystem::remove(file("a.db"));
    write_campaign(whole, file("a.db"));
    Database(file("a.db")).execute(sql);
    EXPECT_TRUE(is_refused("a.db"));
    EXPECT_REFUSED(load_campaign(file("a.db")), error);
    EXPECT_REFUSED(Store(file("a.db")), error);
    EXPECT_EQ(salvage_campaign(file("a.db")).lost, lost);
  }
}

/// Changes the number of rows, and the sum of their checksums, that the table `contents` claims for `table`.
void claim_rows(const std::filesystem::path& store, const std::string& table, const std::string& rows,
                std::uint64_t sum = 0) {
  const std::string key = '"' + table + '"';
  const std::string value = R"({"rows":)" + rows + R"(,"sum":)" + std::to_string(sum) + '}';
  Database(store).execute("UPDATE contents SET value = '" + value + "', checksum = " +
                          std::to_string(checksum("contents", key, value)) + " WHERE key = '" + key + "'");
}

// A store may claim any number of rows, but loading looks up no more rows than the file can hold.
TEST_F(DamageTest, AnyNumberOfRowsMayBeClaimed) {
  for (const char* table : {"run", "shard", "finding", "picture", "campaign", "counts", "oracle", "funnel",
                            "factor", "simulated", "version", "seen", "extreme"})
    claim_rows(file("a.db"), table, "4611686018427387904");
  EXPECT_REFUSED(load_campaign(file("a.db")), "some rows are not as they were saved");
  EXPECT_THAT(salvage_campaign(file("a.db")).lost,
              HasSubstr("4611686018427387901 of 4611686018427387904 rows of seen"));
}

TEST_F(DamageTest, RowsDoNotShareALongValue) {
  constexpr std::size_t page_size = 4096;
  // SQLite stores 489 bytes of the row on the table's page, and the other bytes of the row on other pages.
  const std::string key = R"([0,"scene:cloth"])";
  const std::string value = R"({"points":")" + std::string(489 + 25 * (page_size - 4) + 3800, 'x') + "\"}";
  write_campaign({{{{}, {}, {}, {{"scene:cloth", value}}}}, {}}, file("b.db"));
  // The table's page has one cell, which begins with the row's size (three bytes) and the row's id. Three
  // copies of the cell, with other ids, share the other pages of the row.
  std::string bytes = read("b.db");
  const std::size_t page = bytes.find(key + value.substr(0, 9)) / page_size * page_size;
  std::size_t start =
      256 * static_cast<unsigned char>(bytes[page + 5]) + static_cast<unsigned char>(bytes[page + 6]);
  std::string cell = bytes.substr(page + start, page_size - start);
  for (char id = 2; id <= 4; ++id) {
    start -= cell.size();
    cell[3] = id;
    bytes.replace(page + start, cell.size(), cell);
    const std::size_t pointer = page + 8 + 2 * static_cast<std::size_t>(id - 1);
    bytes[pointer] = static_cast<char>(start / 256);
    bytes[pointer + 1] = static_cast<char>(start % 256);
  }
  bytes[page + 4] = 4;
  bytes[page + 5] = static_cast<char>(start / 256);
  bytes[page + 6] = static_cast<char>(start % 256);
  write("b.db", bytes);
  claim_rows(file("b.db"), "picture", "4", 4 * static_cast<std::uint64_t>(checksum("picture", key, value)));
  EXPECT_REFUSED(load_campaign(file("b.db")), "without 2 of 4 rows of picture");
}

TEST_F(DamageTest, APictureIsAnObject) {
  write_campaign({{{{}, {}, {}, {{"scene:cloth", "{}"}}}}, {}}, file("b.db"));
  const std::int64_t sum = checksum("picture", R"([0,"scene:cloth"])", "1");
  Database(file("b.db")).execute("UPDATE picture SET value = '1', checksum = " + std::to_string(sum));
  EXPECT_REFUSED(load_campaign(file("b.db")), "b.db: table picture: type must be object, but is number");
}

TEST_F(DamageTest, ATextThatIsNotPrintableIsRefused) {
  for (std::string Finding::*const text : {&Finding::subject, &Finding::provenance, &Finding::signature}) {
    Finding finding = some_finding("here");
    finding.*text = "wang\nFAKE: ok\x1b[2J";
    write_campaign({{{{}, {}, {finding}}}, {}}, file("b.db"));
    EXPECT_REFUSED(load_campaign(file("b.db")), "b.db: table finding: the text 'wang");
    std::filesystem::remove(file("b.db"));
  }
  for (const char* text : {"a\x7f", "two\nlines"}) {
    write_campaign({{{{{text, "b"}}, {}, {}}}, {}}, file("b.db"));
    EXPECT_REFUSED(load_campaign(file("b.db")), "b.db: table run: the text '" + std::string(text));
    std::filesystem::remove(file("b.db"));
  }
  write_campaign({{}, some_statistics("\x1b]0;wang\a")}, file("c.db"));
  EXPECT_REFUSED(load_campaign(file("c.db")), "c.db: table counts: the text");
}

TEST_F(DamageTest, ACounterIsAnIntegerThatFits) {
  Campaign one{{{}}, {}};
  const Signature signature = signature_of(some_finding("0"));
  one.statistics.seen[signature] = 1;
  write_campaign(one, file("b.db"));
  const std::string key = nlohmann::json(signature).dump();
  for (const char* value : {"1e308", "-1", "1.0", "18446744073709551616", "true", "[]"}) {
    const std::int64_t sum = checksum("seen", key, value);
    Database(file("b.db"))
        .execute("UPDATE seen SET value = '" + std::string(value) + "', checksum = " + std::to_string(sum));
    claim_rows(file("b.db"), "seen", "1", static_cast<std::uint64_t>(sum));
    EXPECT_ERROR(load_campaign(file("b.db")),
                 EndsWith(", expected an integer from 0 to 18446744073709551615"));
  }
}

TEST_F(DamageTest, ARowOfAnEarlierSaveIsNoticed) {
  for (const char* name : {"old.db", "new.db"})
    Store(file(name), testing::info, shard).save(some_statistics("wang"), shard, {});
  Statistics later = some_statistics("wang");
  later.merge(some_statistics("wang"));
  Store(file("new.db")).save(later, shard, {});
  Database(file("new.db"))
      .execute("ATTACH '" + file("old.db").string() +
               "' AS old; INSERT OR REPLACE INTO counts SELECT * FROM old.counts WHERE rowid = 1");
  EXPECT_ERROR(load_campaign(file("new.db")), EndsWith("the last save of counts"));
}

TEST_F(DamageTest, OfAnIndexStopsWriting) {
  Store(file("b.db"), testing::info, shard).save(some_statistics("wang"), shard, {});
  std::string bytes = read("b.db");
  bytes[bytes.rfind("\"family\":\"uniform\",\"kind\":\"ee\",\"subject\":\"wang\"") + 1] = 'g';
  write("b.db", bytes);
  EXPECT_EQ(load_campaign(file("b.db")).statistics, some_statistics("wang"));
  EXPECT_ERROR(Store(file("b.db")), AllOf(HasSubstr("b.db: damaged: row 1 missing from index"),
                                          EndsWith("--salvage saves 15 rows, without any loss")));
  EXPECT_EQ(read("b.db"), bytes);
}

TEST_F(DamageTest, ACutFileGivesTheRowsBeforeTheCut) {
  const std::string bytes = read("a.db");
  for (const std::size_t size : {std::size_t{0}, std::size_t{50}, bytes.size() / 2, bytes.size() - 4096}) {
    write("b.db", bytes.substr(0, size));
    EXPECT_TRUE(is_refused("b.db")) << size;
  }
  EXPECT_GT(salvage_campaign(write("b.db", bytes.substr(0, bytes.size() / 2))).rows, 0);
}

TEST_F(DamageTest, AFindingWasSeenAtLeastOnce) {
  Database(file("a.db")).execute("DELETE FROM seen");
  const Campaign part = salvage_campaign(file("a.db")).campaign;
  std::map<Signature, std::uint64_t> stored;
  for (const Finding& finding : part.findings()) ++stored[signature_of(finding)];
  EXPECT_FALSE(stored.empty());
  EXPECT_EQ(part.statistics.seen, stored);
}

TEST_F(DamageTest, ASalvageIsNotMergedWithItsOriginal) {
  const std::array<std::string, 2> names{"whole.db", "salvaged.db"};
  Database(file("a.db")).execute("DELETE FROM seen");
  EXPECT_ERROR(
      merge_campaigns(std::array{whole, salvage_campaign(file("a.db")).campaign}, names),
      AllOf(HasSubstr("whole.db and salvaged.db: both have shard "), Not(HasSubstr("salvaged lost"))));
}

TEST_F(DamageTest, ASalvageWithoutItsRunIsNotMerged) {
  const std::array<std::string, 2> names{"whole.db", "salvaged.db"};
  Database(file("a.db")).execute("UPDATE run SET value = '{}' WHERE rowid = 1");
  const std::array both{whole, salvage_campaign(file("a.db")).campaign};
  EXPECT_EQ(both[1].runs[0].info, (RunInfo{{"command", "unknown"},
                                           {salvaged_fact, "lost 1 of 2 rows of run"},
                                           {origin_fact, "partly unknown"}}));
  EXPECT_EQ(both[1].runs[0].findings, whole.runs[0].findings);
  EXPECT_REFUSED(merge_campaigns(both, names), "salvaged.db: found results of an unknown run");
  merge_campaigns(std::span(both).last(1), std::span(names).last(1));
}

}  // namespace
}  // namespace nearmiss
