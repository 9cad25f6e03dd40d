// Tests what happens if there is trouble while a command runs: locks, interrupts, full disks, closed streams,
// and too little memory.
#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <system_error>
#include <thread>

#include "tests/reports/stored.hpp"
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::Background;
using testing::CommandLine;
using ::testing::HasSubstr;

/// A pseudo-terminal. The test reads from `ours` what a command writes to the file `path`.
struct Terminal {
  int ours = posix_openpt(O_RDWR | O_NOCTTY), side = -1;
  std::string path;

  Terminal() {
    EXPECT_TRUE(ours >= 0 && grantpt(ours) == 0 && unlockpt(ours) == 0);
    path = ptsname(ours);
    side = open(path.c_str(), O_RDWR | O_NOCTTY);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal() {
    close(side);
    close(ours);
  }
};

// ^S stops the output of a terminal. A campaign that shows its progress on a stopped terminal ends all the
// same.
TEST_F(CommandLine, AStoppedTerminalStopsNothing) {
  const Terminal terminal;
  ASSERT_EQ(tcflow(terminal.side, TCOOFF), 0);
  expect_code(0, "fuzz --subject wang --time 1s --db a.db", "timeout -s KILL 60", "2>" + terminal.path);
  EXPECT_GT(report_of("a.db")["runs"][0]["cases_done"], 0);
}

TEST_F(CommandLine, ProgressBeginsWithTheTimeThatIsLeft) {
  const Terminal terminal;
  expect_code(0, "fuzz --subject wang --time 2s", "timeout -s KILL 60", "2>" + terminal.path);
  std::string shown(4096, '\0');
  const ssize_t size = ::read(terminal.ours, shown.data(), shown.size());
  shown.resize(static_cast<std::size_t>(std::max(size, ssize_t{0})));
  EXPECT_THAT(shown, ::testing::ContainsRegex("\\] +[0-9]+ % [01] s left, [0-9,]+ cases, "));
}

TEST_F(CommandLine, APluginThatLoadsLongerThanTheCampaignMayTakeIsNoInterrupt) {
  expect_refused("fuzz --subject wang,'pipe:sleep 60' --time 1s --db new.db",
                 {"--time: found 1s, expected more time: the CCDs take longer to load"});
}

TEST_F(CommandLine, HostileArithmeticIsCorrectedAndReported) {
  write("q.vt", hit + "0.25 0.25 1  0 0 0  1 0 0  0 1 0   0.25 0.25 0x1p-1074  0 0 0  1 0 0  0 1 0\n");
  const std::string before = "LD_PRELOAD=" + plugin("hostile");
  const std::string says =
      "nearmiss: found arithmetic that rounds upward, flushes subnormals to zero, takes subnormals for zero, "
      "expected rounding to nearest with subnormals; changed to that\n";
  const Output output = run("oracle --kind vt --distance q.vt", before);
  EXPECT_EQ(output.error, says);
  EXPECT_EQ(output.out, run("oracle --kind vt --distance q.vt").out);
  // In the threads of a campaign, and in the processes of its plug-ins, nearmiss also sets the arithmetic to
  // rounding to nearest with subnormals.
  const auto positives = [&](const std::string& preload) {
    const json subjects =
        json_of(1,
                "fuzz --family scale@-1070,planted --cases 200 --no-shrink --quiet --subject wang," +
                    plugin("hostile"),
                preload)["subjects"];
    EXPECT_EQ(subjects["hostile"]["vt"]["positives"], 0);
    return subjects["wang"]["vt"]["positives"].get<int>();
  };
  EXPECT_EQ(positives(before), positives(""));
}

constexpr const char* endless_campaign = "fuzz --family uniform --time 24h --db a.db";

TEST_F(CommandLine, ACampaignOutlastsALockOfItsStore) {
  Background campaign(file(""), endless_campaign);
  ASSERT_TRUE(wait_for_a_save(campaign)) << read("error.txt");
  {
    const testing::Database other(file("a.db"));
    other.execute("PRAGMA busy_timeout = 60000; BEGIN IMMEDIATE");
    std::this_thread::sleep_for(std::chrono::seconds(3));  // this is longer than a save waits for the lock
    EXPECT_FALSE(campaign.has_ended()) << read("error.txt");
  }
  ASSERT_TRUE(wait_for_a_save(campaign)) << read("error.txt");
  campaign.stop(SIGINT);
  EXPECT_EQ(campaign.code(), 130) << read("error.txt");
}

TEST_F(CommandLine, ASceneOutlastsALockOfItsStore) {
  Background scene(file(""), "scene tumbling@100000 --subject wang --db a.db");
  ASSERT_TRUE(wait_for_a_save(scene)) << read("error.txt");
  {
    const testing::Database other(file("a.db"));
    other.execute("PRAGMA busy_timeout = 60000; BEGIN IMMEDIATE");
    scene.send(SIGINT);  // now the scene must save its results and its picture, but the store is locked
    std::this_thread::sleep_for(std::chrono::seconds(4));
    EXPECT_FALSE(scene.has_ended()) << read("error.txt");
  }
  scene.stop(0);
  EXPECT_EQ(scene.code(), 130) << read("error.txt");
  EXPECT_GE(report_of("a.db")["pictures"].size(), 1);
}

TEST_F(CommandLine, AnInterruptSavesEverything) {
  std::string queries;
  for (int i = 0; i < 100'000; ++i) queries += miss;
  write("q.vt", queries);
  constexpr int all = 300;
  const std::vector<std::pair<std::string, int>> commands{
      {"fuzz --time 24h --search --family uniform", 1},
      {fmt::format("fuzz --cases {} --subject {}", all, plugin("crash")), all},  // while it shrinks
      {"ladder --time 24h", 1},
      {"tightness --time 24h --values 0,1 --subject '" + plugin("sampling") + ":tolerance=*'", 1},
      {"replay q.vt --subject " + plugin("waits"), 1}};
  for (const auto& [command, cases] : commands) {
    Background process(file(""), command + " --db a.db", "NEARMISS_ONE_IN=2");
    ASSERT_TRUE(wait_for_a_save(process, cases)) << command << read("error.txt");
    process.stop(SIGINT);
    EXPECT_EQ(process.code(), 130) << command << read("error.txt");
    EXPECT_THAT(read("out.txt"), HasSubstr("\nmore: ")) << command;
    EXPECT_LE(run("report a.db -o report").code, 1) << command;
    EXPECT_GE(read_json("report/report.json")["runs"][0]["cases_done"], cases) << command;
    std::filesystem::remove(file("a.db"));
  }
}

TEST_F(CommandLine, AFullDiskIsReportedAndLosesNothingThatWasSaved) {
  // A limit on the size of files simulates a full disk.
  const Output output = expect_code(2, "fuzz --time 24h --subject basic --family planted --db a.db",
                                    "ulimit -f 1200; trap '' XFSZ;");
  EXPECT_EQ(std::count(output.error.begin(), output.error.end(), '\n'), 1) << output.error;
  EXPECT_THAT(output.error, HasSubstr("a.db: "));
  expect_code(1, "merge b.db a.db");
  // A file that could not be written completely is removed.
  expect_code(2, "replay hit.vt --json new.json", "ulimit -f 4; trap '' XFSZ;");
  EXPECT_THAT(expect_code(2, "scene spikes@400 --subject wang --export new", "ulimit -f 8;").error,
              HasSubstr("cannot be written"));
  for (const auto& each : std::filesystem::directory_iterator(file("")))
    EXPECT_THAT(each.path().filename().string(), ::testing::Not(::testing::StartsWith("new")));
}

TEST_F(CommandLine, AFullDiskLeavesNoPartOfAStoreWithoutResults) {
  if (std::system("unshare -rm true 2>/dev/null") != 0) GTEST_SKIP() << "found no permission to mount a disk";
  // The disk has room for the store's tables, but not for results. The disk exists as long as the shell runs.
  const std::string with_disk =
      "unshare -rm sh -c 'mkdir disk && mount -t tmpfs -o size=400k none disk && \"$@\"; code=$?; ls disk > "
      "left.txt; exit $code' sh";
  EXPECT_EQ(expect_code(2, "fuzz --quiet --cases 4000 --no-shrink --subject basic,wang,exact --db disk/a.db",
                        with_disk)
                .error,
            "nearmiss: disk/a.db: database or disk is full\n");
  EXPECT_EQ(read("left.txt"), "");
}

TEST_F(CommandLine, AMergeOnASmallDiskIsCompleteOrLeavesNothing) {
  if (std::system("unshare -rm true 2>/dev/null") != 0) GTEST_SKIP() << "found no permission to mount a disk";
  expect_code(1, "fuzz --quiet --cases 4000 --no-shrink --subject basic,wang --db a.db");
  expect_code(1, "merge whole.db a.db");
  for (const std::uintmax_t percent : {50, 90, 110}) {
    SCOPED_TRACE(percent);
    std::filesystem::remove_all(file("disk"));
    // The disk exists as long as the shell runs, so the shell copies the disk's content to the folder "left".
    const std::string with_disk = fmt::format(
        "rm -rf left; unshare -rm sh -c 'mkdir disk && mount -t tmpfs -o size={} none disk && "
        "\"$@\"; code=$?; cp -r disk left; exit $code' sh",
        std::filesystem::file_size(file("whole.db")) * percent / 100);
    const bool fits = percent > 100;
    const Output output = expect_code(fits ? 1 : 2, "merge disk/new.db a.db", with_disk);
    EXPECT_EQ(output.error, fits ? "" : "nearmiss: disk/new.db: database or disk is full\n");
    EXPECT_EQ(read("left/new.db"), fits ? read("whole.db") : "");
    std::filesystem::remove(file("left/new.db"));
    EXPECT_TRUE(std::filesystem::is_empty(file("left")));
  }
}

TEST_F(CommandLine, OutputWithoutAReaderIsAnError) {
  (void)run("family uniform --seed 1 --kind vt --count 100000", "{",
            ">&3; echo $? >code.txt; } 3>&1 >none.txt | true");
  EXPECT_EQ(read("code.txt"), "2\n");
  EXPECT_EQ(read("error.txt"), "nearmiss: standard output cannot be written: Broken pipe\n");
  const Output output = expect_code(2, "family uniform --seed 1 --kind vt --count 100000", "ulimit -f 8;");
  EXPECT_EQ(output.error, "nearmiss: standard output cannot be written: File too large\n");
}

/// A mesh of 20,000 triangles in the same place. A command needs minutes to look at all pairs of these
/// triangles.
std::string crowd() {
  constexpr int triangles = 20'000;
  std::string vertices;
  std::string faces;
  for (int i = 0; i < triangles; ++i) {
    vertices += "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    faces += fmt::format("f {} {} {}\n", 3 * i + 1, 3 * i + 2, 3 * i + 3);
  }
  return vertices + faces;
}

TEST_F(CommandLine, AnInterruptEndsACommandThatSavesNothing) {
  ASSERT_EQ(mkfifo(file("endless").c_str(), 0600), 0);
  write("crowd.obj", crowd());
  const std::string hang = " --query-time 24h --subject " + plugin("hang");
  const std::vector<std::string> commands{"verdict --kind vt <>endless",
                                          "verdict --kind vt hit.vt" + hang,
                                          "family uniform --seed 1 --kind vt --count 1000000000",
                                          "shrink hit.vt" + hang,
                                          "replay hit.vt" + hang,
                                          "bench --queries 3000000 --kind vt --family uniform",
                                          "bench hit.vt" + hang,
                                          "power --time 24h",
                                          "tightness --time 24h",
                                          "fuzz --cases 10 --subject " + plugin("escaping_stop_while_loaded"),
                                          "fuzz --mesh crowd.obj crowd.obj --family mesh --cases 10",
                                          "scene knot@1000000",
                                          "scene crowd.obj crowd.obj --bound pair,scene",
                                          "scene tumbling@20000 --verify-plan",
                                          "scene crowd.obj crowd.obj --export pairs"};
  const std::array signals{SIGINT, SIGTERM, SIGHUP};
  for (std::size_t i = 0; i < commands.size(); ++i) {
    Background process(file(""), commands[i], "NEARMISS_ONE_IN=1");
    ASSERT_TRUE(process.wait_until_it_handles_interrupts()) << commands[i];
    process.stop(signals[i % signals.size()]);
    EXPECT_EQ(process.code(), 130) << commands[i];
  }
}

TEST_F(CommandLine, AnInterruptEndsACommandWhoseOutputHasNoReader) {
  ASSERT_EQ(mkfifo(file("unread").c_str(), 0600), 0);
  Background replay(file(""), "replay hit.vt --subject wang --db a.db --json unread");
  ASSERT_TRUE(replay.wait_until([&] { return !read("out.txt").empty(); })) << read("error.txt");
  replay.send(SIGTERM);
  // If the command still waits for a reader, this call lets the command go on.
  const int reader = open(file("unread").c_str(), O_RDONLY | O_NONBLOCK);
  (void)replay.wait_until([] { return false; });
  close(reader);
  EXPECT_EQ(replay.code(), 130) << read("error.txt");
  EXPECT_EQ(report_of("a.db")["subjects"]["wang"]["vt"]["queries"], 1);
}

TEST_F(CommandLine, FewThreadsAreEnoughIfTheyAreLimited) {
  // 1,500 threads with stacks of 4 MB, TBB's default, do not fit into 4 GB of address space. A limit on the
  // number of processes does not apply to root, so the test sets this limit for another user.
  const std::string user = geteuid() == 0 ? "setpriv --reuid 12345 --regid 12345 --clear-groups " : "";
  std::vector<std::string> limits{"ulimit -s 8192; ulimit -v 4000000;",
                                  "ulimit -s 2000000; ulimit -v 4000000;"};
  if (run("--version", user).code == 0) limits.push_back(user + "prlimit --nproc=300");
  const std::string campaign = "fuzz --subject basic --family planted-ulp --cases 1000 --no-shrink --jobs ";
  const json expected = json_of(1, campaign + "2")["oracle"];
  for (const std::string& limit : limits)
    EXPECT_EQ(json_of(1, campaign + "1500", limit)["oracle"], expected) << limit;
}

TEST_F(CommandLine, ATimeLimitCountsTheCollectingOfPairs) {
  write("crowd.obj", crowd());
  expect_refused("fuzz --mesh crowd.obj crowd.obj --family mesh --time 100ms --db new.db",
                 {"--time: found 100ms, expected more time"});
}

TEST_F(CommandLine, AClosedStandardStreamIsAnErrorWhereItIsNeeded) {
  EXPECT_THAT(expect_code(2, "fuzz --cases 100 --family uniform --db a.db", "", ">&-").error,
              HasSubstr("nearmiss: standard output cannot be written: "));
  EXPECT_EQ(report_of("a.db")["subjects"]["wang"]["vt"]["queries"], 50);
  EXPECT_THAT(expect_code(2, "oracle --kind vt -", "", "<&-").error, HasSubstr("nearmiss: stdin"));
}

TEST_F(CommandLine, AClosedStandardStreamDoesNotMatterWhereItIsNotNeeded) {
  const std::string replay = "replay hit.vt --subject wang," + plugin("print") + " --db ";
  expect_code(0, replay + "a.db", "", "<&-");
  const Output silent = expect_code(0, replay + "b.db", "", "2>&-");
  EXPECT_THAT(silent.out, HasSubstr(" ok  wang: reports the collision\n"));
  // The store and its lock file may get the descriptors of closed streams. Even then, printed text never gets
  // into these files.
  EXPECT_EQ(run(replay + "c.db", "", "<&- >&- 2>&-").code, 2);
  for (const char* store : {"a.db", "b.db", "c.db"})
    EXPECT_EQ(run(std::string("report ") + store + " -o report").code, 0) << store;
}

/// A cgroup whose processes together may use 300 MB of memory.
class SmallCgroup {
 public:
  SmallCgroup() {
    for (const std::filesystem::path root : {"/sys/fs/cgroup/memory", "/sys/fs/cgroup"}) {
      folder_ = root / ("nearmiss-test-" + std::to_string(std::random_device()()));
      std::error_code error;
      if (!std::filesystem::create_directory(folder_, error)) continue;
      for (const char* limit : {"memory.limit_in_bytes", "memory.max"})
        exists_ |= write_to(folder_ / limit, "300000000");
      for (const char* none : {"memory.swappiness", "memory.swap.max"}) write_to(folder_ / none, "0");
      if (exists_) return;
      rmdir(folder_.c_str());
    }
  }
  SmallCgroup(const SmallCgroup&) = delete;
  SmallCgroup& operator=(const SmallCgroup&) = delete;
  ~SmallCgroup() {
    if (exists_) rmdir(folder_.c_str());
  }

  [[nodiscard]] bool exists() const { return exists_; }
  [[nodiscard]] std::string enter() const { return "echo $$ >" + (folder_ / "cgroup.procs").string() + ";"; }

 private:
  static bool write_to(const std::filesystem::path& file, const char* text) {
    if (!std::filesystem::exists(file)) return false;
    std::ofstream out(file);
    out << text << std::flush;
    return out.good();
  }

  std::filesystem::path folder_;
  bool exists_ = false;
};

// When the memory of the cgroup is used up, the kernel ends only processes of the plug-in, never nearmiss.
TEST_F(CommandLine, APluginThatUsesUpTheMemoryOfACgroupEndsAlone) {
  const SmallCgroup small;
  if (!small.exists()) GTEST_SKIP() << "found no cgroup whose memory can be limited";
  const std::string fuzz =
      "fuzz --cases 1000 --family uniform --jobs 2 --no-shrink --query-memory 50M --db a.db --subject wang,";
  const Output output = run(fuzz + plugin("eat_in_children"), small.enter() + " NEARMISS_ONE_IN=500");
  EXPECT_THAT(output.code, ::testing::AnyOf(0, 1)) << output.error;
  const json counts = report_of("a.db", output.code)["subjects"];
  for (const char* subject : {"wang", "misbehaving"})
    EXPECT_EQ(counts[subject]["vt"]["queries"].get<int>() + counts[subject]["ee"]["queries"].get<int>(),
              1000);
}

TEST_F(CommandLine, TooLittleMemoryIsReportedOnOneLine) {
  constexpr int cannot_load = 127;  // the exit code of the dynamic linker
  bool is_reported = false;
  for (int kilobytes = 30'000; kilobytes <= 44'000; kilobytes += 2000) {
    const Output output = run("replay " NEARMISS_CORPUS " --subject basic --jobs 2",
                              "ulimit -v " + std::to_string(kilobytes) + ";");
    EXPECT_THAT(output.code, ::testing::AnyOf(0, 1, 2, cannot_load)) << kilobytes << output.error;
    is_reported |= output.error == "nearmiss: found too little memory\n";
  }
  EXPECT_TRUE(is_reported);
}

TEST_F(CommandLine, AFileInMemoryIsLimited) {
  expect_code(0,
              "fuzz --cases 100 --family uniform --query-memory 50M --subject " + plugin("eat_file") +
                  " --json a.json",
              "NEARMISS_ONE_IN=20");
}

}  // namespace
}  // namespace nearmiss
