// Whatever a plug-in does, each query gets an answer or a fault, and the plug-in leaves nothing behind.
#include <gmock/gmock.h>

#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "ccd/query/error.hpp"
#include "fuzz/subjects/isolation/computing_time.hpp"
#include "fuzz/subjects/isolation/fault_texts.hpp"
#include "fuzz/subjects/isolation/isolated_plugin.hpp"
#include "fuzz/trial/signatures.hpp"
#include "tests/plugins.hpp"
#include "tests/refused.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

// nearmiss reads the computing time of processes from /proc. A process may end while nearmiss reads that
// process's files.
TEST(ComputingTime, OfProcessesThatEndMeanwhileIsNotAnError) {
  std::atomic<bool> is_over = false;
  std::thread parent([&] {
    while (!is_over) {
      const pid_t child = fork();
      if (child == 0) _exit(0);
      waitpid(child, nullptr, 0);
    }
  });
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(500);
  while (std::chrono::steady_clock::now() < end) {
    EXPECT_NO_THROW((void)isolation::computing_time_of_tree(getpid()));
    EXPECT_NO_THROW((void)isolation::largest_data_of_tree(getpid()));
  }
  is_over = true;
  parent.join();
}

using testing::answers_of;
using testing::chosen;
using testing::CopiedPlugin;
using testing::plugin;
using testing::queries;

struct Intrusion {
  std::string name;
  Fault fault;  ///< the fault of the query at which the plug-in intrudes; none if the intrusion is harmless
};

void PrintTo(const Intrusion& each, std::ostream* out) { *out << each.name; }

class Intruding : public ::testing::TestWithParam<Intrusion> {};
INSTANTIATE_TEST_SUITE_P(All, Intruding,
                         ::testing::Values(Intrusion{"write", Fault::protocol},
                                           Intrusion{"close", Fault::protocol},
                                           Intrusion{"truncate", Fault::none},
                                           Intrusion{"move_on", Fault::time},
                                           Intrusion{"fork", Fault::crash}),
                         [](const auto& each) { return each.param.name; });

TEST_P(Intruding, IsAFaultOfOneQueryAtMost) {
  const CopiedPlugin copied("intruding_" + GetParam().name);
  {
    const auto subject = make_isolated_plugin(copied.path(), {.time = std::chrono::milliseconds(100)});
    EXPECT_GT(copied.processes(), 0);
    const auto asked = queries();
    const auto verdicts = answers_of(*subject, asked);
    int faults = 0;
    for (const Verdict& verdict : verdicts) {
      EXPECT_EQ(verdict.hit, verdict.fault == Fault::none);
      faults += verdict.fault == Fault::none ? 0 : 1;
    }
    EXPECT_EQ(faults, GetParam().fault == Fault::none ? 0 : 1);
    // If the plug-in broke the worker's channel, nearmiss does not know at which query this happened.
    if (GetParam().fault != Fault::protocol) {
      EXPECT_EQ(verdicts[chosen].fault, GetParam().fault);
    }
  }
  EXPECT_EQ(copied.processes(), 0);
}

/// The number of files that nearmiss has open, and the number of its memory mappings that it shares with
/// workers.
std::array<std::size_t, 2> held() {
  std::array<std::size_t, 2> count{};
  for ([[maybe_unused]] const auto& each : std::filesystem::directory_iterator("/proc/self/fd")) ++count[0];
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);)
    count[1] += line.find("memfd:nearmiss-") != line.npos ? 1 : 0;
  return count;
}

TEST(Isolation, LeavesNoFileAndNoMemory) {
  const auto before = held();
  {
    const auto subject = make_isolated_plugin(plugin("crash"));
    const auto during = held();
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_GT(during[i], before[i]);
    answers_of(*subject, queries());  // replaces the worker
    EXPECT_EQ(held(), during);
  }
  EXPECT_EQ(held(), before);
}

/// While an object of this class exists, this process blocks all signals, and ignores the end of its
/// children.
class ForeignSignals {
 public:
  ForeignSignals() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
    reaction_ = std::signal(SIGCHLD, SIG_IGN);
  }
  ForeignSignals(const ForeignSignals&) = delete;
  ForeignSignals& operator=(const ForeignSignals&) = delete;
  ~ForeignSignals() {
    std::signal(SIGCHLD, reaction_);
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

 private:
  sigset_t before_{};
  decltype(SIG_DFL) reaction_;
};

TEST(Isolation, DoesNotDependOnTheSignalsOfItsParent) {
  const ForeignSignals foreign;
  setenv("NEARMISS_ONE_IN", "1", 1);
  const Verdict verdict = make_isolated_plugin(plugin("crash"))->decide(queries().front());
  unsetenv("NEARMISS_ONE_IN");
  EXPECT_EQ(verdict.fault, Fault::crash);
  EXPECT_EQ(verdict.fault_code, SIGSEGV);
}

/// Sets the environment variable NEARMISS_MARK to the name of a file, in which a plug-in leaves a mark.
class Marking : public testing::TemporaryFolder {
 protected:
  Marking() { setenv("NEARMISS_MARK", file("mark").c_str(), 1); }
  ~Marking() override { unsetenv("NEARMISS_MARK"); }
};

class LaterProcess : public Marking, public ::testing::WithParamInterface<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, LaterProcess, ::testing::Values("leaves_later", "renamed_later"));

TEST_P(LaterProcess, ThatCannotBeUsedIsAFaultOfTheLaterQueries) {
  const auto subject = make_isolated_plugin(plugin(GetParam()));
  const auto asked = queries();
  const auto verdicts = answers_of(*subject, asked);
  for (std::size_t i = 0; i < asked.size(); ++i)
    EXPECT_EQ(verdicts[i].fault, i < chosen ? Fault::none : i == chosen ? Fault::crash : Fault::load) << i;
  EXPECT_THAT(subject->fault_text(verdicts.back()),
              ::testing::HasSubstr(std::string(GetParam()) + ".so: the plug-in "));
  EXPECT_EQ(answers_of(*subject, asked).front().fault, Fault::load);
}

TEST_F(Marking, ClosingIsTheEndOfADetector) {
  {
    const auto subject = make_isolated_plugin(plugin("closes"), {.leaving = std::chrono::minutes(1)});
    for (const Verdict& verdict : answers_of(*subject, queries())) EXPECT_TRUE(verdict.hit);
    EXPECT_FALSE(std::filesystem::exists(file("mark")));
  }
  EXPECT_TRUE(std::filesystem::exists(file("mark")));
  const CopiedPlugin copied("closes_never");
  EXPECT_TRUE(make_isolated_plugin(copied.path())->decide(queries().front()).hit);
  EXPECT_EQ(copied.processes(), 0);
}

// If a part of /proc is hidden, as in containers, the system refuses to mount a new /proc.
TEST(Isolation, DoesNotNeedAProcOfItsOwn) {
  const std::string hidden =
      "unshare -rmpf --mount-proc sh -c 'mount -t tmpfs none /proc/fs && exec unshare -rm \"$@\"' sh ";
  if (std::system((hidden + "true 2>/dev/null").c_str()) != 0) GTEST_SKIP() << "found no namespaces";
  const std::string tests = std::filesystem::read_symlink("/proc/self/exe").string() +
                            " --gtest_filter=Isolation.TellsWhetherABoundIsClaimed:ProgramTest.SaysWhat*";
  EXPECT_EQ(std::system((hidden + tests + " >/dev/null").c_str()), 0);
}

std::vector<pid_t> tree_of(pid_t root) {
  std::vector<pid_t> tree{root};
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const std::string process = std::to_string(tree[i]);
    std::ifstream children("/proc/" + process + "/task/" + process + "/children");
    for (pid_t child = 0; children >> child;) tree.push_back(child);
  }
  return tree;
}

// The plug-in computes for an eighth of a second per query. The time limit of 0.4 s allows a query to take up
// to 4 s of wall-clock time. The test suspends all processes for more than 4 s.
TEST(Isolation, TimeInWhichEverythingIsSuspendedDoesNotCount) {
  std::array<int, 2> ready{};
  ASSERT_EQ(pipe(ready.data()), 0);
  const pid_t child = fork();
  if (child == 0) {
    const auto subject = make_isolated_plugin(plugin("computes"), {.time = std::chrono::milliseconds(400)});
    if (write(ready[1], "", 1) != 1) _exit(1);
    const auto verdicts = answers_of(*subject, std::vector<Query>(8));
    _exit(std::all_of(verdicts.begin(), verdicts.end(), [](const Verdict& each) { return each.hit; }) ? 0
                                                                                                      : 1);
  }
  char byte = 0;
  EXPECT_EQ(read(ready[0], &byte, 1), 1);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const std::vector<pid_t> all = tree_of(child);
  for (const pid_t process : all) kill(process, SIGSTOP);
  std::this_thread::sleep_for(std::chrono::milliseconds(4500));
  for (const pid_t process : all) kill(process, SIGCONT);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  for (const int end : ready) close(end);
}

TEST(Isolation, ACrashLeavesItsStackAndTheEndOfItsOutput) {
  setenv("NEARMISS_ONE_IN", "1", 1);
  const auto subject = make_isolated_plugin(plugin("crash"));
  const Verdict crashed = subject->decide(queries().front());
  unsetenv("NEARMISS_ONE_IN");
  EXPECT_EQ(crashed.fault, Fault::crash);
  EXPECT_EQ(crashed.fault_code, SIGSEGV);
  const std::string errors = subject->fault_errors(crashed);
  EXPECT_LE(errors.size(), 2048);
  EXPECT_THAT(errors, ::testing::HasSubstr("\n?[31mlast words\n"));
  EXPECT_THAT(errors, ::testing::ContainsRegex("/crash.so\\([^[]*\\)\n"));
  for (const char* absent : {"first words", "nearmiss-worker"})
    EXPECT_THAT(errors, ::testing::Not(::testing::HasSubstr(absent)));
  EXPECT_EQ(subject->fault_errors({.fault = Fault::crash, .fault_code = SIGFPE}), "");
}

TEST(FaultTexts, AreAThousandWhoseNumbersStay) {
  FaultTexts texts;
  for (int i = 0; i < 3000; ++i) texts.number("text " + std::to_string(i));
  EXPECT_EQ(texts.text(0), "text 0");
  EXPECT_EQ(texts.text(998), "text 998");
  EXPECT_EQ(texts.text(999), "one of more than a thousand texts");
  EXPECT_EQ(texts.number("text 998"), 998);
  EXPECT_EQ(texts.number("another"), 999);
}

TEST(Isolation, MayStartSomeProcesses) {
  const auto subject = make_isolated_plugin(plugin("process_limit"));
  EXPECT_TRUE(subject->decide(queries().front()).hit);
}

// throwing.cpp throws an exception with a text for a query with x > 0.9, and an exception without a text for
// x = 0.5. It crashes for x = -2.
TEST(Isolation, AnExceptionIsAFaultWithItsText) {
  const auto subject = make_isolated_plugin(plugin("throwing"));
  auto asked = queries();
  for (std::size_t i = 0; i < asked.size(); i += 2) asked[i].x[0] = 0.95;
  asked[1].x[0] = 0.5;
  asked.back().x[0] = -2;
  const auto verdicts = answers_of(*subject, asked);
  for (std::size_t i = 0; i < asked.size(); ++i)
    EXPECT_EQ(verdicts[i].fault, i + 1 == asked.size()  ? Fault::crash
                                 : asked[i].x[0] > 0.25 ? Fault::exception
                                                        : Fault::none)
        << i;
  EXPECT_EQ(subject->fault_text(verdicts[1]), "std::exception");
  const std::string text = subject->fault_text(verdicts[0]);
  EXPECT_EQ(text, "no root in [0.950000, 1] ?[31m");
  EXPECT_EQ(fault_signature(Kind::vertex_triangle, verdicts[0], text), "vt exception no root in [#, #] ?[#m");
}

TEST(Isolation, AnExceptionWhileThePluginIsLoadedIsSaid) {
  EXPECT_REFUSED(make_isolated_plugin(plugin("throwing_while_loaded")),
                 "the plug-in threw an exception: no licence while it was loaded");
}

/// A valid description of a plug-in, as a worker writes it.
isolation::PluginDescription honest() {
  isolation::PluginDescription about;
  about.name = {"mine:tolerance=1"};
  about.names = {"mine\nother\n"};
  about.kinds = NEARMISS_EDGE_EDGE;
  return about;
}

TEST(Isolation, WhatAWorkerWritesOfItsPluginIsPossible) {
  EXPECT_EQ(isolation::info_of(honest(), "tolerance=1").name, "mine:tolerance=1");
  EXPECT_THAT(isolation::names_of(honest()), ::testing::ElementsAre("mine", "other"));
  isolation::PluginDescription odd = honest();
  odd.name = {"+1\033[31m\xff:tolerance=1"};
  odd.kinds = odd.time_sort = -1;
  odd.batch = ~std::uint64_t{0};
  const DetectorInfo info = isolation::info_of(odd, "tolerance=1");
  EXPECT_EQ(info.name, "+1?[31m?:tolerance=1");
  EXPECT_EQ(info.kinds, bits_of_all_kinds);
  EXPECT_EQ(info.time_sort, TimeSort::none);
  EXPECT_EQ(info.batch, largest_batch);
}

TEST(Isolation, AContractThatIsNoneAndNamesThatAreNoneAreRefused) {
  for (const double limit : {HUGE_VAL, -1.0, std::nan("")}) {
    isolation::PluginDescription odd = honest();
    odd.grid = limit;
    EXPECT_THROW(isolation::info_of(odd, "tolerance=1"), Error) << limit;
  }
  EXPECT_THROW(isolation::info_of(honest(), "tolerance=2"), Error);
  for (const char* name : {"", "a/b", "a=b:c", "wang (beyond contract)", "defect:vv"}) {
    isolation::PluginDescription odd = honest();
    odd.name = {};
    std::copy_n(name, std::strlen(name), odd.name.begin());
    EXPECT_THROW(isolation::info_of(odd, "tolerance=1"), Error) << name;
  }
  isolation::PluginDescription odd = honest();
  odd.names = {"a:b\n"};
  EXPECT_THROW(isolation::names_of(odd), Error);
}

TEST(Isolation, ANameThatIsNoneIsRefused) {
  EXPECT_REFUSED(make_isolated_plugin(plugin("bad_name")),
                 "found a name with characters that are not seen, or that is no UTF-8");
}

}  // namespace
}  // namespace nearmiss
