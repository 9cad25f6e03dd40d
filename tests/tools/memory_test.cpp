// Tests nearmiss when memory is short.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::CommandLine;

/// A cgroup whose processes together may use 300 MB of memory.
class SmallCgroup {
 public:
  SmallCgroup() {
    for (const std::filesystem::path root : {"/sys/fs/cgroup/memory", "/sys/fs/cgroup"}) {
      folder_ = root / ("nearmiss-test-" + std::to_string(getpid()));
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
  /// The command by which a shell enters it.
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

// The system ends only processes of the plug-in, whichever of these it chooses.
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
  for (int kilobytes = 30'000; kilobytes <= 44'000; kilobytes += 1000) {
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
