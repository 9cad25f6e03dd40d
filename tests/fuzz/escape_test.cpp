// A plug-in that tries to act on the processes around it reaches none of them, with or without its own PID
// namespace.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/capability.h>
#include <sched.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "ccd/query/error.hpp"
#include "fuzz/subjects/isolation/isolated_plugin.hpp"
#include "tests/plugins.hpp"

namespace nearmiss {
namespace {

using testing::answers_of;
using testing::chosen;
using testing::CopiedPlugin;
using testing::plugin;
using testing::queries;

/// Whether the system grants this user a PID namespace.
bool grants_namespaces() {
  const pid_t child = fork();
  if (child == 0) {
    constexpr int own = CLONE_NEWPID | CLONE_NEWNS | CLONE_NEWNET | CLONE_NEWIPC;
    _exit(unshare(own) == 0 || unshare(CLONE_NEWUSER | own) == 0 ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status == 0;
}

/// The parameter says whether the plug-in may have a PID namespace.
class Containment : public ::testing::TestWithParam<bool> {
 protected:
  Containment() { setenv("NEARMISS_PROCESS", std::to_string(getpid()).c_str(), 1); }

  [[nodiscard]] static isolation::PluginLimits limits() { return {.own_namespace = GetParam()}; }
  /// Whether the operating system refuses the forbidden action that the plug-in of this name attempts.
  [[nodiscard]] static bool refuses(const std::string& name) {
    const auto subject = make_isolated_plugin(plugin(name), limits());
    const Verdict verdict = answers_of(*subject, queries())[chosen];
    EXPECT_EQ(verdict.fault, Fault::none);
    return verdict.hit;
  }
};
INSTANTIATE_TEST_SUITE_P(All, Containment, ::testing::Bool(), [](const auto& each) {
  return std::string(each.param ? "InANamespace" : "WithoutANamespace");
});

TEST_P(Containment, EndsAllProcesses) {
  for (const char* name : {"escaping_kill", "escaping_stop"}) {
    const CopiedPlugin copied(name);
    {
      const auto subject = make_isolated_plugin(copied.path(), limits());
      for (const Verdict& verdict : answers_of(*subject, queries())) EXPECT_TRUE(verdict.hit);
      EXPECT_GT(copied.processes(), 0);
    }
    EXPECT_EQ(copied.processes(), 0) << name;
  }
}

TEST_P(Containment, APluginEndsItsOwnGroupOnly) {
  const CopiedPlugin copied("escaping_kill_group");
  {
    const auto subject = make_isolated_plugin(copied.path(), limits());
    const auto verdicts = answers_of(*subject, queries());
    for (std::size_t i = 0; i < verdicts.size(); ++i)
      EXPECT_EQ(verdicts[i].fault, i == chosen ? Fault::crash : Fault::none) << i;
    EXPECT_EQ(verdicts[chosen].fault_code, SIGKILL);
  }
  EXPECT_EQ(copied.processes(), 0);
}

TEST_P(Containment, EndsAllProcessesOfAPluginThatDoesNotLoad) {
  for (const char* name : {"escaping_kill_while_loaded", "escaping_stop_while_loaded"}) {
    const CopiedPlugin copied(name);
    isolation::PluginLimits brief = limits();
    brief.loading = std::chrono::milliseconds(20);
    EXPECT_THROW(make_isolated_plugin(copied.path(), brief), Error);
    EXPECT_EQ(copied.processes(), 0) << name;
  }
}

TEST_P(Containment, EndsAllProcessesWhenThisProcessIsKilled) {
  for (const char* name : {"escaping_stop", "escaping_trace"}) {
    const CopiedPlugin copied(name);
    int ready[2];
    ASSERT_EQ(pipe(ready), 0);
    const pid_t child = fork();
    if (child == 0) {
      setenv("NEARMISS_PROCESS", std::to_string(getpid()).c_str(), 1);
      setenv("NEARMISS_ADDRESS", "0", 1);
      const auto subject = make_isolated_plugin(copied.path(), limits());
      answers_of(*subject, queries());
      if (write(ready[1], "", 1) == 1)
        while (true) pause();
      _exit(1);
    }
    close(ready[1]);
    char byte = 0;
    EXPECT_EQ(read(ready[0], &byte, 1), 1);
    close(ready[0]);
    EXPECT_GT(copied.processes(), 0);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    // When nearmiss is killed, the plug-in's processes are killed, too, but nobody waits for their end. If
    // they still exist after a minute, the test fails.
    constexpr int tries = 6000;
    for (int i = 0; i < tries && copied.processes() > 0; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(copied.processes(), 0) << name;
  }
}

std::atomic<int> signals{0};

TEST_P(Containment, NoSignalReachesThisProcessWhichIsNotSlowedDown) {
  signals = 0;
  const auto before = std::signal(SIGUSR1, [](int) { ++signals; });
  const int scheduler = sched_getscheduler(0), priority = getpriority(PRIO_PROCESS, 0);
  EXPECT_TRUE(refuses("escaping_signal"));
  EXPECT_TRUE(refuses("escaping_schedule"));
  std::signal(SIGUSR1, before);
  EXPECT_EQ(signals, 0);
  EXPECT_EQ(sched_getscheduler(0), scheduler);
  EXPECT_EQ(getpriority(PRIO_PROCESS, 0), priority);
}

TEST_P(Containment, NoProcessCanBeTraced) {
  static volatile char memory = 0;
  setenv("NEARMISS_ADDRESS", std::to_string(reinterpret_cast<std::uintptr_t>(&memory)).c_str(), 1);
  EXPECT_TRUE(refuses("escaping_trace"));
  EXPECT_EQ(memory, 0);
}

bool has_landlock() { return syscall(SYS_landlock_create_ruleset, nullptr, 0, 1) > 0; }

TEST_P(Containment, NoOtherProcessOfTheUserCanBeRead) {
  if (!GetParam() && !has_landlock()) GTEST_SKIP() << "found no Landlock";
  // The victim drops its privileges, so that it is like any other process of an ordinary user.
  const pid_t victim = fork();
  if (victim == 0) {
    __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
    std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> none{};
    syscall(SYS_capset, &header, none.data());
    prctl(PR_SET_DUMPABLE, 1);
    while (true) pause();
  }
  ASSERT_GT(victim, 0);
  setenv("NEARMISS_PROCESS", std::to_string(victim).c_str(), 1);
  setenv("NEARMISS_ADDRESS", "0", 1);
  EXPECT_TRUE(refuses("escaping_trace"));
  EXPECT_TRUE(refuses("escaping_schedule"));
  kill(victim, SIGKILL);
  waitpid(victim, nullptr, 0);
}

// nearmiss ends a plug-in by ending its process group: all processes of the group end, even if they start new
// processes faster than nearmiss can find these.
TEST_P(Containment, NoProcessLeavesTheGroupThatEndsWithThePlugin) {
  EXPECT_EQ(refuses("escaping_leave"), !GetParam() || !grants_namespaces());  // a namespace would end them
}

TEST_P(Containment, APluginHasNoPrivilegesExceptOnFilesAndReachesNoKeyrings) {
  EXPECT_TRUE(refuses("escaping_privileges"));
  EXPECT_TRUE(refuses("escaping_keyrings"));
}

TEST_P(Containment, APluginHasItsOwnNamespaceIfTheSystemGrantsOne) {
  EXPECT_EQ(refuses("escaping_namespace"), GetParam() && grants_namespaces());
}

TEST_P(Containment, TheTerminalOfTheUserIsOutOfReach) {
  const int ours = posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_TRUE(ours >= 0 && grantpt(ours) == 0 && unlockpt(ours) == 0);
  setenv("NEARMISS_TERMINAL", ptsname(ours), 1);
  EXPECT_TRUE(refuses("escaping_terminal"));
  close(ours);
}

/// The number of System V shared memory segments that this process sees.
std::ptrdiff_t segments() {
  std::ifstream all("/proc/sysvipc/shm");
  return std::count(std::istreambuf_iterator<char>(all), {}, '\n');
}

TEST_P(Containment, SharedMemoryIsLimitedAndGoesWithThePlugin) {
  if (!GetParam() || !grants_namespaces()) GTEST_SKIP() << "found no namespaces";
  const std::ptrdiff_t before = segments();
  EXPECT_TRUE(refuses("escaping_shared"));
  EXPECT_EQ(segments(), before);
  EXPECT_FALSE(std::filesystem::exists("/dev/shm/nearmiss-left"));
}

}  // namespace
}  // namespace nearmiss
