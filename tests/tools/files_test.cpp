// Files that commands write are complete or absent, and no file of the user's is lost.
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using testing::Background;
using testing::CommandLine;
using ::testing::HasSubstr;

/// Words to put before a command, so that file permissions hold even for root.
const std::string as_reader = geteuid() == 0 ? "setpriv --bounding-set=-dac_override" : "";

TEST_F(CommandLine, AFileBesideItsPlaceIsTheUsers) {
  write("o.json.part", "mine");
  write("precious", "mine, too");
  std::filesystem::create_symlink("precious", file("o.json.part1"));
  EXPECT_EQ(run("fuzz --cases 100 --json o.json").code, 0);
  EXPECT_FALSE(std::filesystem::is_symlink(file("o.json")));
  EXPECT_EQ(read_json("o.json")["subjects"].size(), 1);
  EXPECT_EQ(read("o.json.part"), "mine");
  EXPECT_EQ(read("precious"), "mine, too");
}

TEST_F(CommandLine, AFileThatCannotBeWrittenIsRefusedAtOnce) {
  std::filesystem::create_directory(file("folder"));
  write("q.vt", hit);
  for (const std::string command : {"fuzz --time 24h", "replay q.vt"})
    expect_refused(command + " --json folder", {"folder: found a folder, expected a file"});
  std::filesystem::permissions(file("folder"), std::filesystem::perms{0555});
  const Output refused = expect_code(2, "fuzz --time 24h --json folder/a.json", as_reader);
  EXPECT_EQ(refused.error, "nearmiss: folder/a.json: cannot be written: Permission denied\n");
}

TEST_F(CommandLine, AFileIsReplacedAsAWholeAlsoBehindALink) {
  write("q.vt", hit);
  std::filesystem::create_symlink("a.json", file("link.json"));
  for (const std::string path : {"a.json", "link.json"}) {
    write("a.json", "old");
    std::filesystem::remove(file("reader.json"));
    std::filesystem::create_hard_link(file("a.json"), file("reader.json"));
    expect_code(0, "replay q.vt --json " + path);
    EXPECT_TRUE(std::filesystem::is_symlink(file("link.json"))) << path;
    EXPECT_EQ(read_json("a.json")["subjects"]["wang"]["vt"]["queries"], 1) << path;
    EXPECT_EQ(read("reader.json"), "old") << path;
  }
}

TEST_F(CommandLine, AnOpenFileIsWrittenNotReplaced) {
  write("q.vt", hit);
  EXPECT_EQ(run("replay q.vt --json /dev/fd/3", "", "3>open.json").code, 0);
  EXPECT_EQ(read_json("open.json")["subjects"]["wang"]["vt"]["queries"], 1);
}

TEST_F(CommandLine, ADeviceIsWrittenNotReplaced) {
  write("q.vt", hit);
  const Output output = run("replay q.vt --json /dev/stdout | cat");
  EXPECT_THAT(output.out, HasSubstr("\"false_negatives\": 0"));
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

}  // namespace
}  // namespace nearmiss
