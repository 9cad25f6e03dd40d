// Plug-ins in worker processes. Whatever a plug-in does at one query, all other queries are answered.
#include <gmock/gmock.h>
#include <sched.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "fuzz/families/families.hpp"
#include "fuzz/parallel.hpp"
#include "fuzz/subjects/isolation/isolated_plugin.hpp"
#include "fuzz/trial/signatures.hpp"
#include "tests/fuzz/family_queries.hpp"
#include "tests/plugins.hpp"
#include "tests/refused.hpp"

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define NEARMISS_SANITIZER_ENDS_A_PROCESS_OUT_OF_MEMORY
#endif
#endif

namespace nearmiss {
namespace {

using testing::answers_of;
using testing::first_queries;
using testing::plugin;

/// Whether tests/plugin/misbehaving.c misbehaves on a query.
bool is_chosen(const Query& query) {
  std::uint64_t hash = 0;
  for (const double c : query.x) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15U;
    hash ^= hash >> 29;
  }
  return hash % 100 == 0;
}

/// Limits with little memory. The time limit is short only for plug-ins that are meant to exceed it: on a
/// busy machine, other plug-ins might exceed a short limit, too.
isolation::PluginLimits limits_for(Fault fault) {
  const auto time = fault == Fault::time ? std::chrono::milliseconds(100) : std::chrono::seconds(60);
  return {.time = time, .bytes = std::uint64_t{64} << 20};
}

/// Queries of one kind, which a worker receives in one batch.
std::vector<Query> one_batch(std::uint64_t count) {
  std::vector<Query> queries;
  for (std::uint64_t i = 0; i < count; ++i) queries.push_back(make_query(find_family("uniform"), 1, 2 * i));
  return queries;
}

TEST(Isolation, TellsWhetherABoundIsClaimed) {
  for (const char* name : {"example", "always", "hostile"}) {
    const auto direct = make_subject(plugin(name));
    EXPECT_EQ(make_isolated_plugin(plugin(name))->claims_bound(), direct->claims_bound()) << name;
    EXPECT_EQ(direct->claims_bound(), std::isfinite(direct->distance_bound(first_queries("uniform", 1)[0])))
        << name;
  }
}

TEST(Isolation, AnswersAsThePluginDoesInOurProcess) {
  const auto isolated = make_isolated_plugin(plugin("example"));
  const auto direct = make_subject(plugin("example"));
  EXPECT_EQ(isolated->name(), direct->name());
  const auto queries = first_queries("uniform", 2000);
  std::vector<Verdict> verdicts(queries.size());
  const BatchTime time = isolated->decide_timed(queries, verdicts);
  EXPECT_EQ(time.queries, queries.size());
  std::vector<std::optional<std::uint64_t>> times(queries.size());
  isolated->time_each(queries, times);
  std::vector<BoundAnswer> bounds(queries.size());
  isolated->ask_bounds(queries, bounds);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    EXPECT_EQ(verdicts[i].hit, direct->decide(queries[i]).hit) << i;
    EXPECT_TRUE(times[i].has_value());
    EXPECT_EQ(bounds[i].bound, direct->distance_bound(queries[i])) << i;
  }
}

// The plug-in always sleeps at least as long as the test expects, so the test passes on a slow machine, too.
TEST(Isolation, WaitingForADeviceCounts) {
  const auto queries = first_queries("uniform", 20);
  std::vector<Verdict> verdicts(queries.size());
  for (const bool isolated : {false, true}) {
    const auto subject = isolated ? make_isolated_plugin(plugin("waits")) : make_subject(plugin("waits"));
    const BatchTime time = subject->decide_timed(queries, verdicts);
    EXPECT_EQ(time.queries, 20);
    EXPECT_GE(time.nanoseconds, 20 * 90'000);
    std::vector<std::optional<std::uint64_t>> times(queries.size());
    subject->time_each(queries, times);
    for (const auto& each : times) EXPECT_GE(each, 90'000);
  }
}

void use_one_processor() {
  cpu_set_t allowed;
  sched_getaffinity(0, sizeof allowed, &allowed);
  std::size_t first = 0;
  while (!CPU_ISSET(first, &allowed)) ++first;
  CPU_ZERO(&allowed);
  CPU_SET(first, &allowed);
  sched_setaffinity(0, sizeof allowed, &allowed);
}

/// Uses the processor for some milliseconds. Afterwards, the operating system prefers other processes to this
/// one.
void compute_for_some_time() {
  const auto start = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - start < std::chrono::milliseconds(5)) {
  }
}

// The plug-in computes at least as long as the test expects, so the test does not depend on speed.
TEST(Isolation, TimeCountsEvenIfTheWorkerIsDoneBeforeNearmissRunsAgain) {
  std::vector<std::uint64_t> nanoseconds;
  std::thread([&] {
    use_one_processor();
    const auto subject = make_isolated_plugin(plugin("computes_briefly"));
    const auto queries = one_batch(50);
    std::vector<Verdict> verdicts(queries.size());
    for (int i = 0; i < 20; ++i) {
      compute_for_some_time();
      nanoseconds.push_back(subject->decide_timed(queries, verdicts).nanoseconds);
    }
  }).join();
  EXPECT_THAT(nanoseconds, ::testing::Each(::testing::Ge(50 * 9'000U)));
}

// The plug-ins compute at least as long as the tests expect, so the tests do not depend on speed.
TEST(Isolation, TheComputingTimeOfAChildCounts) {
  const auto subject = make_isolated_plugin(plugin("computes_in_a_child"));
  const auto queries = one_batch(50);
  std::vector<Verdict> verdicts(queries.size());
  std::thread([&] {
    use_one_processor();  // so that the child of the plug-in's process gets the processor
    subject->decide_timed(queries, verdicts);  // starts the child
    for (int i = 0; i < 3; ++i)
      EXPECT_GE(subject->decide_timed(queries, verdicts).nanoseconds, 50 * 900'000U / 2);
  }).join();
}

TEST(Isolation, ComputingCountsEvenIfThePluginDoesItBeforeItIsTimed) {
  const auto subject = make_isolated_plugin(plugin("computes_ahead"));
  const auto queries = one_batch(100);
  std::vector<Verdict> verdicts(50);
  subject->decide_timed(std::span(queries).first(50), verdicts);
  EXPECT_GE(subject->decide_timed(std::span(queries).last(50), verdicts).nanoseconds,
            (50 * 90'000U - 500'000U) / 2);
}

TEST(Isolation, MemoryIsLimitedWhileAPluginIsLoaded) {
  const std::map<std::string, std::vector<const char*>> refused{
      {"It was refused memory: expected at most twice --query-memory",
       {"eat_while_loaded", "too_large", "too_large_mapping"}},
      {"the plug-in took too much memory while it was loaded: expected at most twice --query-memory",
       {"too_large_static", "too_large_static_used", "too_large_child"}}};
  for (const auto& [text, names] : refused)
    for (const char* name : names)
      EXPECT_REFUSED(make_isolated_plugin(plugin(name), limits_for(Fault::memory)), text) << name;
}

TEST(Isolation, WhateverLoadingTookAQueryMayUseItsMemory) {
  const auto subject = make_isolated_plugin(plugin("large"), limits_for(Fault::memory));
  EXPECT_TRUE(subject->decide(one_batch(1).front()).hit);
}

// The plug-in's process may die at any moment. Each answer that the process leaves behind must be an answer
// of the plug-in.
TEST(Isolation, AnAnswerIsThePluginsEvenIfItsProcessDiesWhileItIsTimed) {
  const auto subject = make_isolated_plugin(plugin("aborts_later"));
  const auto queries = one_batch(50);
  std::vector<Verdict> verdicts(queries.size());
  for (int crashes = 0; crashes < 40;) {
    subject->decide_timed(queries, verdicts);
    for (const Verdict& verdict : verdicts) {
      EXPECT_EQ(verdict.hit, verdict.fault == Fault::none);
      crashes += verdict.fault == Fault::crash ? 1 : 0;
    }
  }
}

struct Misbehaviour {
  std::string plugin, signature;
  Fault fault;
};

void PrintTo(const Misbehaviour& each, std::ostream* out) { *out << each.plugin; }

class Misbehaving : public ::testing::TestWithParam<Misbehaviour> {};
INSTANTIATE_TEST_SUITE_P(All, Misbehaving,
                         ::testing::Values(Misbehaviour{"crash", "crash SEGV", Fault::crash},
                                           Misbehaviour{"leave", "exit 3", Fault::crash},
                                           Misbehaviour{"hang", "time", Fault::time},
                                           Misbehaviour{"sleep", "time", Fault::time},
                                           Misbehaviour{"eat", "memory", Fault::memory},
                                           Misbehaviour{"fail", "error -7", Fault::error}),
                         [](const auto& each) { return each.param.plugin; });

TEST_P(Misbehaving, IsCountedAndAllElseIsAnswered) {
#ifdef NEARMISS_SANITIZER_ENDS_A_PROCESS_OUT_OF_MEMORY
  if (GetParam().fault == Fault::memory) GTEST_SKIP() << "the sanitizer ends a process that is out of memory";
#endif
  const auto subject = make_isolated_plugin(plugin(GetParam().plugin), limits_for(GetParam().fault));
  const auto queries = first_queries("uniform", 600);
  std::vector<Verdict> verdicts(queries.size());
  in_parallel(2, 4, [&](std::size_t part) {
    subject->decide(std::span(queries).subspan(150 * part, 150),
                    std::span(verdicts).subspan(150 * part, 150));
  });
  int chosen = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Verdict& verdict = verdicts[i];
    EXPECT_EQ(verdict.hit, verdict.fault == Fault::none) << i;
    if (!is_chosen(queries[i])) {
      // On a busy machine, any query may exceed the time limit, even one for which the plug-in does nothing
      // unusual.
      EXPECT_TRUE(verdict.fault == Fault::none || GetParam().fault == Fault::time) << i;
      continue;
    }
    ++chosen;
    EXPECT_EQ(verdict.fault, GetParam().fault) << i;
    EXPECT_EQ(fault_signature(queries[i].kind, verdict),
              std::string(short_name(queries[i].kind)) + " " + GetParam().signature);
  }
  EXPECT_GE(chosen, 2);
}

/// While an object of this class exists, this process can open no more files, and so can start no worker.
class NoFiles {
 public:
  NoFiles() {
    getrlimit(RLIMIT_NOFILE, &before_);
    const int next = dup(STDERR_FILENO);
    close(next);
    const rlimit limit{static_cast<rlim_t>(next), before_.rlim_max};
    setrlimit(RLIMIT_NOFILE, &limit);
  }
  NoFiles(const NoFiles&) = delete;
  NoFiles& operator=(const NoFiles&) = delete;
  ~NoFiles() { setrlimit(RLIMIT_NOFILE, &before_); }

 private:
  rlimit before_{};
};

TEST(Isolation, WhereNoWorkerCanBeStartedNoPluginIsToBlame) {
  setenv("NEARMISS_ONE_IN", "1", 1);
  const auto subject = make_isolated_plugin(plugin("crash"));
  std::optional<NoFiles> lack(std::in_place);
  std::thread relief([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    lack.reset();
  });
  for (const Verdict& verdict : answers_of(*subject, one_batch(3))) EXPECT_EQ(verdict.fault, Fault::crash);
  relief.join();
  unsetenv("NEARMISS_ONE_IN");
}

TEST(Isolation, AStopDoesNotWaitForAWorkerThatDoesNotStart) {
  const std::atomic<bool> requested = true;
  const Stop stop(requested);
  setenv("NEARMISS_ONE_IN", "1", 1);
  setenv("LD_PRELOAD", plugin("sleep_while_loaded").c_str(), 1);
  EXPECT_THROW(make_isolated_plugin(plugin("example"), {.stop = &stop}), Stopped);
  unsetenv("LD_PRELOAD");
  unsetenv("NEARMISS_ONE_IN");
}

TEST(Isolation, EachQueryHasTheWholeTimeLimit) {
  // Each of the 12 queries takes an eighth of a second. Together, the queries take longer than the limit for
  // one query.
  const auto subject = make_isolated_plugin(plugin("computes"), {.time = std::chrono::seconds(1)});
  for (const Verdict& verdict : answers_of(*subject, one_batch(12))) EXPECT_EQ(verdict.fault, Fault::none);
}

#ifndef NEARMISS_SANITIZER_ENDS_A_PROCESS_OUT_OF_MEMORY
TEST(Isolation, ACrashAfterARefusedAllocationIsACrash) {
  const auto subject = make_isolated_plugin(plugin("recovers"), limits_for(Fault::crash));
  const auto verdicts = answers_of(*subject, one_batch(4));
  for (std::size_t i = 0; i < verdicts.size(); ++i)
    EXPECT_EQ(verdicts[i].fault, i % 2 == 0 ? Fault::none : Fault::crash) << i;
}
#endif

TEST(Isolation, WhatThePluginPrintsIsLost) {
  const auto subject = make_isolated_plugin(plugin("print"));
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  answers_of(*subject, first_queries("uniform", 600));
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace nearmiss
