// If a command writes a file, the file is complete or absent. No command loses a file of the user. All
// results in a store come from one build of nearmiss and one build of each plug-in.
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "reports/sha256.hpp"
#include "reports/store/store.hpp"
#include "tests/reports/stored.hpp"
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::Background;
using testing::CommandLine;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

/// With this prefix, a command must obey file permissions even if root runs it.
const std::string as_reader = geteuid() == 0 ? "setpriv --bounding-set=-dac_override" : "";

TEST_F(CommandLine, AFileBesideItsPlaceIsTheUsers) {
  write("o.json.part", "mine");
  write("precious", "mine, too");
  std::filesystem::create_symlink("precious", file("o.json.part1"));
  expect_code(0, "fuzz --cases 100 --json o.json");
  EXPECT_FALSE(std::filesystem::is_symlink(file("o.json")));
  EXPECT_EQ(read_json("o.json")["subjects"].size(), 1);
  EXPECT_EQ(read("o.json.part"), "mine");
  EXPECT_EQ(read("precious"), "mine, too");
}

TEST_F(CommandLine, AFileThatCannotBeWrittenIsRefusedAtOnce) {
  std::filesystem::create_directory(file("folder"));
  for (const std::string command : {"fuzz --time 24h", "replay hit.vt"})
    expect_refused(command + " --json folder", {"folder: found a folder, expected a file"});
  std::filesystem::permissions(file("folder"), std::filesystem::perms{0555});
  const Output refused = expect_code(2, "fuzz --time 24h --json folder/a.json", as_reader);
  EXPECT_EQ(refused.error, "nearmiss: folder/a.json: cannot be written: Permission denied\n");
}

TEST_F(CommandLine, AFileIsReplacedAsAWholeAlsoBehindALink) {
  std::filesystem::create_symlink("a.json", file("link.json"));
  for (const std::string path : {"a.json", "link.json"}) {
    write("a.json", "old");
    std::filesystem::remove(file("reader.json"));
    std::filesystem::create_hard_link(file("a.json"), file("reader.json"));
    expect_code(0, "replay hit.vt --json " + path);
    EXPECT_TRUE(std::filesystem::is_symlink(file("link.json"))) << path;
    EXPECT_EQ(read_json("a.json")["subjects"]["wang"]["vt"]["queries"], 1) << path;
    EXPECT_EQ(read("reader.json"), "old") << path;
  }
}

TEST_F(CommandLine, AnOpenFileOrADeviceIsWrittenNotReplaced) {
  expect_code(0, "replay hit.vt --json /dev/fd/3", "", "3>open.json");
  EXPECT_EQ(read_json("open.json")["subjects"]["wang"]["vt"]["queries"], 1);
  EXPECT_THAT(run("replay hit.vt --json /dev/stdout | cat").out, HasSubstr("\"false_negatives\": 0"));
  EXPECT_TRUE(std::filesystem::is_symlink("/dev/stdout"));
}

TEST_F(CommandLine, AReportThatMightNeedAllMemoryIsRefused) {
  expect_code(0, "fuzz --cases 100 --subject exact --db a.db");
  expect_code(0, "merge b.db a.db");
  write("b.db-wal", "");
  for (const char* part : {"a.db", "b.db-wal"})
    std::filesystem::resize_file(file(part), std::uintmax_t{129} << 20);
  for (const std::string store : {"a.db", "b.db"})
    expect_refused("report " + store + " -o new", {store + ": found more than 128 MiB of stores"});
  EXPECT_FALSE(std::filesystem::exists(file("new")));
}

TEST_F(CommandLine, AStoreWithItsLogInAReadOnlyFolderIsRefusedWithAdvice) {
  {
    Background campaign(file(""), "fuzz --family uniform --time 24h --db a.db");
    ASSERT_TRUE(wait_for_a_save(campaign)) << read("error.txt");
    campaign.stop(SIGKILL);
  }
  std::filesystem::create_directory(file("archive"));
  for (const char* name : {"a.db", "a.db-wal"})
    std::filesystem::copy_file(file(name), file("archive") / name);
  std::filesystem::permissions(file("archive"), std::filesystem::perms{0555});
  const Output refused = expect_code(2, "report archive/a.db -o report", as_reader);
  EXPECT_THAT(refused.error,
              HasSubstr("archive/a.db: found the log a.db-wal in a folder that cannot be written"));
  std::filesystem::permissions(file("archive"), std::filesystem::perms{0755});
  EXPECT_EQ(run("report archive/a.db -o report", as_reader).code, 0);
}

class SameCode : public CommandLine {
 protected:
  /// Replaces p.so by another plug-in. The plug-ins `always` and `never` have the same name and version.
  void install(const std::string& name) const {
    fs::copy_file(plugin(name), file("new.so"));
    fs::rename(file("new.so"), file("p.so"));
  }

  const std::string campaign = "fuzz --cases 400 --subject ./p.so --family uniform";

  [[nodiscard]] std::string digest() const { return sha256_hex(read("p.so")); }
};

TEST_F(SameCode, AReportSaysWhichCodeRan) {
  install("example");
  expect_code(0, campaign + " --db a.db");
  const json run = report_of("a.db")["runs"][0];
  EXPECT_EQ(run["plug-in boxes sha256"], digest());
  EXPECT_EQ(run["plug-in boxes version"], "1.0");
  EXPECT_EQ(run["environments"][0]["plug-in boxes"], fs::canonical(file("")).string() + "/p.so");
  EXPECT_THAT(run["commit"].get<std::string>(),
              ContainsRegex("^(unknown|[0-9a-f]{40}(-dirty.[0-9a-f]{12})?)$"));
}

TEST_F(SameCode, ResultsOfAnotherPluginDoNotResumeOrMerge) {
  install("always");
  const std::string first = digest();
  expect_code(0, campaign + " --shard 0/2 --db a.db");
  expect_code(0, campaign + " --shard 0/2 --db a.db --resume");
  install("never");
  expect_refused(
      campaign + " --shard 0/2 --db a.db --resume",
      {"a.db: found a run with plug-in always sha256 '" + first + "', expected '" + digest() + "'"});
  expect_code(1, campaign + " --shard 1/2 --db b.db");
  expect_code(1, campaign + " --seed 2 --db c.db --no-shrink");
  expect_refused("merge new.db a.db b.db", {"b.db: found plug-in always sha256 '" + digest() +
                                            "', expected '" + first + "' as in a.db"});
  expect_refused("report a.db b.db -o new", {"b.db: found plug-in always sha256"});
  expect_code(1, "merge new.db a.db c.db");  // runs with different seeds stay separate
  EXPECT_EQ(load_campaign(file("new.db")).runs.size(), 2);
}

TEST_F(SameCode, AnotherNearmissDoesNotResume) {
  expect_code(0, "fuzz --cases 100 --db a.db");
  for (const char* fact : {"commit", "version"}) {
    Campaign other = load_campaign(file("a.db"));
    other.runs[0].info[fact] = "another";
    fs::remove(file("b.db"));
    write_campaign(other, file("b.db"));
    expect_refused("fuzz --cases 100 --db b.db --resume",
                   {std::string("b.db: found a run with ") + fact + " 'another', expected '"});
    expect_refused("merge new.db a.db b.db", {std::string("b.db: found ") + fact + " 'another', expected '"});
  }
}

TEST_F(SameCode, APluginThatIsReplacedEndsTheCampaign) {
  install("example");
  const std::string endless = "fuzz --time 24h --subject ./p.so --family uniform --db a.db";
  Background process(file(""), endless);
  ASSERT_TRUE(wait_for_a_save(process));
  install("always");
  (void)process.wait_until([] { return false; });
  EXPECT_EQ(process.code(), 2);
  const std::string error = read("error.txt");
  EXPECT_THAT(error,
              HasSubstr("nearmiss: ./p.so: the plug-in was changed while it was on trial: found sha256 " +
                        digest() + ", expected the file with sha256 "));
  EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;

  const std::uint64_t cases = report_of("a.db")["runs"][0]["cases_done"];
  EXPECT_GT(cases, 0);
  expect_refused(endless + " --resume", {"a.db: found a run with plug-in boxes sha256 '"});
  install("example");
  expect_code(0, "fuzz --time 1s --subject ./p.so --family uniform --db a.db --resume");
}

class SalvageCommand : public CommandLine {};

TEST_F(SalvageCommand, SavesWhatIsIntact) {
  const std::string campaign = "fuzz --cases 2000 --family small-integer,parallel --subject basic --db ";
  expect_code(1, campaign + "a.db");
  const auto findings = load_campaign(file("a.db")).runs[0].findings;
  ASSERT_GT(findings.size(), 2);
  testing::Database(file("a.db")).execute("UPDATE finding SET value = value || ' ' WHERE rowid = 2");
  const std::string lost = "1 of " + std::to_string(findings.size()) + " rows of finding";
  const std::vector<std::string> words{"a.db: damaged: some rows are not as they were saved",
                                       "nearmiss merge NEW.db a.db --salvage saves ", "without " + lost};
  expect_refused("report a.db -o new", words);
  expect_refused("merge new.db a.db", words);
  expect_refused(campaign + "a.db --resume", words);

  const Output output = expect_code(1, "merge saved.db a.db --salvage");
  EXPECT_THAT(output.out, HasSubstr("a.db: saved "));
  EXPECT_THAT(output.out, HasSubstr("rows, lost " + lost));
  EXPECT_EQ(load_campaign(file("saved.db")).runs[0].findings.size(), findings.size() - 1);
  EXPECT_EQ(report_of("saved.db", 1)["runs"][0]["salvaged"], "lost " + lost);
  expect_refused(campaign + "saved.db --resume",
                 {"saved.db: found a run with salvaged 'lost " + lost + "', expected none"});
}

TEST_F(SalvageCommand, TakesAllOfAnIntactStore) {
  expect_code(1, "fuzz --cases 1000 --family small-integer --no-shrink --subject basic --db a.db");
  EXPECT_THAT(run("merge b.db a.db --salvage").out, HasSubstr("rows, lost nothing"));
  EXPECT_EQ(load_campaign(file("b.db")).runs, load_campaign(file("a.db")).runs);
}

TEST_F(SalvageCommand, RefusesWhatHasNothingIntact) {
  write("text.db", "this is not a database, although it is long enough to be taken for one");
  expect_refused("merge new.db text.db --salvage", {"text.db: file is not a database"});
  expect_refused("merge new.db none.db --salvage", {"none.db: "});
}

}  // namespace
}  // namespace nearmiss
